#include "emit/device_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <dashpot/estimators/estimator_names.hpp>
#include <string_view>

#include "emit/cpp_program.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

const char* name_of(quantiser which) { return which == quantiser::round ? "round" : "floor"; }
const char* name_of(brake_kind which) {
  switch (which) {
    case brake_kind::none: return "none";
    case brake_kind::eddy_current: return "eddy_current";
    case brake_kind::shorted_motor: return "shorted_motor";
  }
  return "";
}

// Numbers have the unit of the joint's own coordinate.
class Facts {
 public:
  Facts(const device_description& device, DeviceLanguage language)
      : language_(language), rotates_(device.motion == motion::rotation) {}

  template <class Choice>
  void choice(const char* field, const char* type, Choice value) {
    const char* name = name_of(value);
    add(field, language_ == DeviceLanguage::cpp ? fmt::format("dashpot::{}::{}", type, name)
                                                : fmt::format("dashpot_{}_{}", type, name));
  }
  void number(const char* field, double value, const char* linear, const char* angular) {
    add(field, cpp_literal(value, ScalarType::float64), rotates_ ? angular : linear);
  }
  void number(const char* field, double value, const char* unit = "") { number(field, value, unit, unit); }
  void count(const char* field, unsigned value, const char* unit = "") { add(field, fmt::format("{}u", value), unit); }
  void flag(const char* field, bool value) {
    add(field, language_ == DeviceLanguage::cpp ? (value ? "true" : "false") : (value ? "1" : "0"));
  }

  std::vector<DeviceFact> take() { return std::move(facts_); }

 private:
  void add(const char* field, std::string value, const char* unit = "") {
    facts_.push_back({field, std::move(value), *unit == '\0' ? "" : fmt::format("[{}]", unit)});
  }

  DeviceLanguage language_;
  bool rotates_;
  std::vector<DeviceFact> facts_;
};

void add_loop(const loop_description& loop, Facts& facts) {
  facts.number("loop.sample_period", loop.sample_period, "s");
  facts.number("loop.jitter", loop.jitter, "s");
  facts.count("loop.delay_samples", loop.delay_samples);
  facts.number("loop.write_earliest", loop.write_earliest, "s");
  facts.number("loop.write_latest", loop.write_latest, "s");
  facts.number("loop.band_low", loop.band_low, "Hz");
  facts.number("loop.band_high", loop.band_high, "Hz");
  facts.number("loop.reference_frequency", loop.reference_frequency, "Hz");
  facts.count("loop.missed_deadlines_allowed", loop.missed_deadlines_allowed);
}

void add_velocity(const velocity_description& velocity, Facts& facts) {
  facts.choice("velocity.estimator", "estimator_kind", velocity.estimator);
  facts.count("velocity.window", velocity.window, "samples");
  facts.count("velocity.order", velocity.order);
  facts.number("velocity.cutoff", velocity.cutoff, "Hz");
  facts.flag("velocity.best_fit", velocity.best_fit);
  facts.number("velocity.acceleration", velocity.acceleration, "m/s²", "rad/s²");
  facts.number("velocity.filter_factor", velocity.filter_factor);
  facts.number("velocity.noise", velocity.noise, "m/s", "rad/s");
  facts.number("velocity.bandwidth", velocity.bandwidth, "Hz");
}

void add_encoder(const encoder_description& encoder, Facts& facts) {
  facts.number("encoder.step", encoder.step, "m", "rad");
  facts.choice("encoder.rounding", "quantiser", encoder.rounding);
  facts.number("encoder.range_low", encoder.range_low, "m", "rad");
  facts.number("encoder.range_high", encoder.range_high, "m", "rad");
  facts.number("encoder.max_speed", encoder.max_speed, "m/s", "rad/s");
}

void add_motor(const motor_description& motor, Facts& facts) {
  facts.number("motor.torque_constant", motor.torque_constant, "N/A", "N·m/A");
  facts.number("motor.max_torque", motor.max_torque, "N", "N·m");
  facts.number("motor.amplifier_lag", motor.amplifier_lag, "s");
  facts.number("motor.slew", motor.slew, "N/s", "N·m/s");
  facts.number("motor.saturation_allowed", motor.saturation_allowed, "s");
  facts.number("motor.noise", motor.noise, "N", "N·m");
}

void add_brake(const brake_description& brake, Facts& facts) {
  facts.choice("brake.kind", "brake_kind", brake.kind);
  facts.number("brake.max_damping", brake.max_damping, "N·s/m", "N·m·s/rad");
  facts.number("brake.damping_per_current_squared", brake.damping_per_current_squared, "N·s/(m·A²)", "N·m·s/(rad·A²)");
  facts.number("brake.residual_damping", brake.residual_damping, "N·s/m", "N·m·s/rad");
  facts.number("brake.tolerance", brake.tolerance);
  facts.number("brake.coil_lag", brake.coil_lag, "s");
  facts.number("brake.slew", brake.slew, "A/s");
  facts.number("brake.critical_speed", brake.critical_speed, "m/s", "rad/s");
  facts.number("brake.safe_damping", brake.safe_damping, "N·s/m", "N·m·s/rad");
}

void add_mechanics(const mechanics_description& mechanics, Facts& facts) {
  facts.number("mechanics.inertia", mechanics.inertia, "kg", "kg·m²");
  facts.number("mechanics.damping", mechanics.damping, "N·s/m", "N·m·s/rad");
  facts.number("mechanics.coulomb_friction", mechanics.coulomb_friction, "N", "N·m");
  facts.number("mechanics.mode.frequency", mechanics.mode.frequency, "Hz");
  facts.number("mechanics.mode.damping_ratio", mechanics.mode.damping_ratio);
  facts.number("mechanics.mode.mass", mechanics.mode.mass, "kg", "kg·m²");
  facts.number("mechanics.backlash", mechanics.backlash, "m", "rad");
}

// Whether only a real-time loop, the mechanics or random draws use this field.
bool is_idle_when_led(const std::string& field, const device_description& device) {
  constexpr std::string_view idle[] = {"loop.jitter",
                                       "loop.band_low",
                                       "loop.band_high",
                                       "loop.reference_frequency",
                                       "loop.missed_deadlines_allowed",
                                       "encoder.range_low",
                                       "encoder.range_high",
                                       "encoder.max_speed",
                                       "velocity.noise",
                                       "motor.torque_constant",
                                       "motor.saturation_allowed",
                                       "motor.noise",
                                       "brake.tolerance",
                                       "brake.safe_damping"};
  return field.starts_with("mechanics.") || (field == "motor.slew" && !(device.motor.slew > 0)) ||
         std::find(std::begin(idle), std::end(idle), field) != std::end(idle);
}

}  // namespace

std::vector<DeviceFact> all_facts(const device_description& device, DeviceLanguage language) {
  Facts facts(device, language);
  facts.choice("motion", "motion", device.motion);
  facts.number("arm_radius", device.arm_radius, "m");
  add_loop(device.loop, facts);
  add_encoder(device.encoder, facts);
  add_velocity(device.velocity, facts);
  add_motor(device.motor, facts);
  add_brake(device.brake, facts);
  add_mechanics(device.mechanics, facts);
  return facts.take();
}

std::vector<DeviceFact> facts_of_led_device(const device_description& device) {
  std::vector<DeviceFact> facts = all_facts(device, DeviceLanguage::cpp);
  std::erase_if(facts, [&](const DeviceFact& fact) { return is_idle_when_led(fact.field, device); });
  return facts;
}

}  // namespace dashpot::compiler
