#include <dashpot/estimators/estimator_fault.hpp>
#include <dashpot/estimators/estimator_names.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <numbers>
#include <utility>

#include "network/device.hpp"
#include "network/expression.hpp"
#include "network/port_units.hpp"
#include "network/rate_limits.hpp"
#include "network/read_motion.hpp"
#include "network/read_value.hpp"
#include "network/section_reader.hpp"
#include "source/excerpt.hpp"
#include "source/nearest_name.hpp"

namespace dashpot::compiler {
namespace {

// Far beyond any machine, so that the products in a certificate stay finite.
constexpr double lowest_speed = 1e-9, highest_speed = 1e9;  // [m/s] or [rad/s]
constexpr double shortest_arm = 1e-6, longest_arm = 1e6;    // [m]
constexpr double longest_time = 1e6;                        // of lags and lateness [s]
constexpr double slowest_mode = 0.1;                        // [Hz]
constexpr double smallest_part = 100;                       // either side of a mode has at least 1/100 of the inertia

// The dimensions of the joint's own coordinate.
struct JointDimensions {
  Dimension position, velocity, acceleration, force, force_rate, damping, inertia, force_constant,
      damping_per_current_squared;
};

constexpr JointDimensions translation_dimensions = {
    dimensions::length, dimensions::velocity,       dimensions::acceleration,
    dimensions::force,  dimensions::force_rate,     dimensions::damping,
    dimensions::mass,   dimensions::force_constant, dimensions::damping_per_current_squared};

constexpr JointDimensions rotation_dimensions = {
    dimensions::angle,   dimensions::angular_velocity, dimensions::angular_acceleration,
    dimensions::torque,  dimensions::torque_rate,      dimensions::rotational_damping,
    dimensions::inertia, dimensions::torque_constant,  dimensions::rotational_damping_per_current_squared};

struct EstimatorKeys {
  estimator_kind kind;
  std::vector<std::string> required;
  std::vector<std::string> optional;
};

const std::vector<EstimatorKeys> estimator_keys = {
    {estimator_kind::backward_difference, {"window"}, {}},
    {estimator_kind::least_squares, {"window"}, {}},
    {estimator_kind::butterworth, {"order", "cutoff"}, {}},
    {estimator_kind::inverse_time, {}, {}},
    {estimator_kind::foaw, {"window"}, {"fit"}},
    {estimator_kind::kalman, {"acceleration"}, {}},
    {estimator_kind::super_twisting, {"acceleration"}, {}},
    {estimator_kind::tracking_differentiator, {"acceleration"}, {"filter_factor"}},
    {estimator_kind::sensor, {}, {"noise", "bandwidth"}},
    {estimator_kind::interval_difference, {}, {}},
};

const std::vector<std::string> all_velocity_keys = {"estimator",    "window",        "order", "cutoff",   "fit",
                                                    "acceleration", "filter_factor", "noise", "bandwidth"};

std::vector<std::string> keys_of(const EstimatorKeys& estimator) {
  std::vector<std::string> keys{"estimator"};
  keys.insert(keys.end(), estimator.required.begin(), estimator.required.end());
  keys.insert(keys.end(), estimator.optional.begin(), estimator.optional.end());
  return keys;
}

std::vector<std::string> estimator_names() {
  std::vector<std::string> names;
  for (const EstimatorKeys& estimator : estimator_keys) names.emplace_back(name_of(estimator.kind));
  return names;
}

// Whether the file has values of a joint that turns, whatever its key `motion` says.
bool tells_of_rotation(const DeviceDecl& decl) {
  if (decl.arm_radius) return true;
  const auto turns = [](const ValueDecl& value) {
    const std::optional<Quantity> quantity = quantity_in(value);
    return quantity && quantity->dimension && quantity->dimension->radian != 0;
  };
  for (const SectionDecl& section : decl.sections)
    for (const EntryDecl& entry : section.entries)
      if (entry.key.text == "counts_per_turn" || std::any_of(entry.values.begin(), entry.values.end(), turns))
        return true;
  return false;
}

// If the file describes a joint that turns without saying so, this is one error instead of one for every value.
motion motion_of_joint(const DeviceDecl& decl, Diagnostics& diagnostics) {
  const bool is_known = decl.motion && (decl.motion->text == "translation" || decl.motion->text == "rotation");
  const motion stated = read_motion(decl.motion, diagnostics);
  if (is_known || stated == motion::rotation || !tells_of_rotation(decl)) return stated;
  if (!decl.motion && !decl.complete) return motion::rotation;  // its key may be misspelt, which is reported
  if (!decl.motion) diagnostics.report<DiagnosticCode::missing_key>(decl.opening, "the device file", "motion");
  diagnostics.note<DiagnosticCode::write_instead>({}, "\"motion\": \"rotation\"");
  return motion::rotation;
}

class DeviceBuilder {
 public:
  DeviceBuilder(const DeviceDecl& decl, Diagnostics& diagnostics)
      : decl_(decl),
        diagnostics_(diagnostics),
        motion_(motion_of_joint(decl, diagnostics)),
        due_(motion_ == motion::rotation ? rotation_dimensions : translation_dimensions) {}

  Device build() {
    read_name();
    device_.source = decl_.source ? decl_.source->text : std::string();
    device_.digest = decl_.digest;
    device_.description.motion = motion_;
    read_arm_radius();
    read_loop();
    read_encoder();
    read_velocity();
    read_motor();
    read_brake();
    read_mechanics();
    read_assumed();
    return std::move(device_);
  }

 private:
  std::string speed_unit() const { return port_units(motion_).velocity; }

  SectionReader section(const char* name) const { return {decl_, name, motion_, diagnostics_}; }

  // It stands in messages and in emitted code.
  void read_name() {
    if (!decl_.name) return;
    device_.name = decl_.name->text;
    if (device_.name.find_first_not_of(" \t\r\n") == std::string::npos)
      diagnostics_.report<DiagnosticCode::blank_device_name>(decl_.name->span);
  }

  void read_arm_radius() {
    if (!decl_.arm_radius) return;
    const ValueDecl& decl = *decl_.arm_radius;
    const auto radius = read_quantity_as(decl, {"'arm_radius'", dimensions::length, motion_}, diagnostics_);
    if (radius && *radius <= 0)
      diagnostics_.report<DiagnosticCode::not_above_zero>(decl.span, "'arm_radius'", fmt::format("{} m", *radius));
    else if (radius && (*radius < shortest_arm || *radius > longest_arm))
      diagnostics_.report<DiagnosticCode::device_limit>(decl.span, "arm_radius", excerpt(decl.text),
                                                        fmt::format("{} to {} m", shortest_arm, longest_arm));
    if (motion_ == motion::translation) diagnostics_.report<DiagnosticCode::arm_without_rotation>(decl.span);
    device_.description.arm_radius = radius.value_or(0);
  }

  void read_loop() {
    SectionReader reader = section("loop");
    loop_description& loop = device_.description.loop;
    reader.refuse_other_keys(
        {"rate", "jitter", "delay_samples", "write_delay", "band", "reference_frequency", "missed_deadlines_allowed"});
    if (!reader.is_present())
      diagnostics_.report<DiagnosticCode::missing_key>(decl_.opening, "the device file", "loop");
    reader.require("rate");
    double rate = 1 / loop.sample_period;
    if (reader.read_within("rate", dimensions::frequency, Bound::above_zero, lowest_rate, highest_rate, "Hz", rate))
      loop.sample_period = 1 / rate;
    const bool is_time =
        reader.read_within("jitter", dimensions::time, Bound::zero_or_more, 0, longest_time, "s", loop.jitter);
    if (is_time && loop.jitter >= loop.sample_period) {
      diagnostics_.report<DiagnosticCode::jitter_of_a_period>(reader.place_of("jitter"), reader.text_of("jitter"),
                                                              1e3 * loop.sample_period);
      diagnostics_.note<DiagnosticCode::jitter_remedy>({});
    }
    reader.read_count("delay_samples", 0, loop.delay_samples);
    if (!reader.is_within("delay_samples", loop.delay_samples, 0, most_delay_samples, "samples"))
      loop.delay_samples = 0;
    read_write_delay(reader, loop);
    reader.read_pair("band", dimensions::frequency, Bound::above_zero, loop.band_low, loop.band_high);
    warn_of_band(reader, loop);
    reader.read("reference_frequency", dimensions::frequency, Bound::zero_or_more, loop.reference_frequency);
    reader.read_count("missed_deadlines_allowed", 0, loop.missed_deadlines_allowed);
    reader.is_within("missed_deadlines_allowed", loop.missed_deadlines_allowed, 0, most_missed_deadlines, "deadlines");
  }

  void warn_of_band(const SectionReader& reader, const loop_description& loop) {
    const double half_rate = 0.5 / loop.sample_period;
    if (!reader.has("band") || loop.band_high <= half_rate) return;
    diagnostics_.report<DiagnosticCode::band_above_half_rate>(reader.place_of("band"), loop.band_high, half_rate);
    diagnostics_.note<DiagnosticCode::band_remedy>({}, half_rate);
  }

  // One time, or the earliest and the latest.
  void read_write_delay(const SectionReader& reader, loop_description& loop) {
    if (reader.is_list("write_delay")) {
      reader.read_pair("write_delay", dimensions::time, Bound::zero_or_more, loop.write_earliest, loop.write_latest,
                       true);
    } else {
      reader.read("write_delay", dimensions::time, Bound::zero_or_more, loop.write_latest);
      loop.write_earliest = loop.write_latest;
    }
    if (loop.write_latest < loop.sample_period) return;
    diagnostics_.report<DiagnosticCode::write_after_a_period>(reader.place_of("write_delay"),
                                                              reader.text_of("write_delay"), 1e3 * loop.sample_period);
    const double samples = std::floor(loop.write_latest / loop.sample_period);
    if (!reader.is_list("write_delay") && samples + loop.delay_samples <= most_delay_samples)
      diagnostics_.note<DiagnosticCode::whole_samples_remedy>({}, loop.delay_samples + unsigned(samples),
                                                              1e3 * (loop.write_latest - samples * loop.sample_period));
    loop.write_earliest = loop.write_latest = 0;
  }

  void read_encoder() {
    SectionReader reader = section("encoder");
    encoder_description& encoder = device_.description.encoder;
    reader.refuse_other_keys({"counts_per_turn", "resolution", "quantiser", "range", "max_speed"});
    read_encoder_step(reader, encoder);
    if (const auto word = reader.read_word("quantiser", {"floor", "round"}))
      encoder.rounding = *word == 0 ? quantiser::floor : quantiser::round;
    reader.read_pair("range", due_.position, Bound::any, encoder.range_low, encoder.range_high);
    reader.read_within("max_speed", due_.velocity, Bound::above_zero, 0, highest_speed, speed_unit(),
                       encoder.max_speed);
  }

  void read_encoder_step(const SectionReader& reader, encoder_description& encoder) {
    constexpr double turn = 6.283185307179586476925286766559;  // [rad]
    unsigned counts = 0;
    reader.read_count("counts_per_turn", 1, counts);
    if (counts > 0) encoder.step = turn / counts;
    reader.read("resolution", due_.position, Bound::above_zero, encoder.step);
    if (reader.has("counts_per_turn") && reader.has("resolution"))
      diagnostics_.report<DiagnosticCode::two_encoder_steps>(reader.place_of("resolution"));
    if (reader.has("counts_per_turn") && motion_ == motion::translation)
      diagnostics_.report<DiagnosticCode::counts_without_rotation>(reader.place_of("counts_per_turn"));
  }

  void read_velocity() {
    SectionReader reader = section("velocity");
    if (!reader.is_present()) return;
    reader.refuse_other_keys(all_velocity_keys);
    reader.require("estimator");
    const auto choice = reader.read_word("estimator", estimator_names());
    if (!choice) return;
    const EstimatorKeys& estimator = estimator_keys[*choice];
    refuse_foreign_keys(reader, estimator);
    for (const std::string& key : estimator.required) reader.require(key);
    device_.description.velocity.estimator = estimator.kind;
    const std::size_t errors_before = diagnostics_.error_count();
    read_settings(reader, device_.description.velocity);
    if (diagnostics_.error_count() == errors_before) check_settings(reader);
  }

  void refuse_foreign_keys(const SectionReader& reader, const EstimatorKeys& estimator) {
    const std::vector<std::string> own = keys_of(estimator);
    for (const std::string& key : all_velocity_keys)
      if (reader.has(key) && std::find(own.begin(), own.end(), key) == own.end()) {
        diagnostics_.report<DiagnosticCode::key_of_other_estimator>(reader.place_of(key), name_of(estimator.kind), key);
        diagnostics_.note<DiagnosticCode::known_keys>({}, fmt::format("{}", fmt::join(own, ", ")));
      }
  }

  void read_settings(const SectionReader& reader, velocity_description& velocity) {
    reader.read_count("window", 1, velocity.window);
    reader.read_count("order", 1, velocity.order);
    reader.read("cutoff", dimensions::frequency, Bound::above_zero, velocity.cutoff);
    if (const auto word = reader.read_word("fit", {"end", "best"})) velocity.best_fit = *word == 1;
    reader.read("acceleration", due_.acceleration, Bound::above_zero, velocity.acceleration);
    reader.read("filter_factor", dimensions::number, Bound::above_zero, velocity.filter_factor);
    reader.read("noise", due_.velocity, Bound::zero_or_more, velocity.noise);
    reader.read("bandwidth", dimensions::frequency, Bound::above_zero, velocity.bandwidth);
  }

  // The estimators themselves say what they can be built from.
  void check_settings(const SectionReader& reader) {
    const device_description& device = device_.description;
    switch (fault_in(device.velocity, device.loop.sample_period, device.encoder.step)) {
      case estimator_fault::none: return;
      case estimator_fault::window:
        return report_setting(reader, "window", fmt::format("1 to {} samples", longest_window));
      case estimator_fault::order: return report_setting(reader, "order", "2 or 4");
      case estimator_fault::cutoff:
        return report_setting(reader, "cutoff",
                              fmt::format("less than {} Hz, half the rate,", 0.5 / device.loop.sample_period));
      case estimator_fault::acceleration: return report_setting(reader, "acceleration", "more than zero");
      case estimator_fault::filter_factor: return report_setting(reader, "filter_factor", "1 or more");
      case estimator_fault::bandwidth: return report_setting(reader, "bandwidth", "more than zero");
      case estimator_fault::encoder_step:
        return diagnostics_.report<DiagnosticCode::estimator_needs_step>(reader.place_of("estimator"),
                                                                         name_of(device.velocity.estimator));
    }
  }

  // A key that is missing has been reported as such.
  void report_setting(const SectionReader& reader, std::string_view key, std::string_view expected) {
    if (reader.has(key))
      diagnostics_.report<DiagnosticCode::estimator_setting>(reader.place_of(key), key, reader.text_of(key), expected);
  }

  void read_motor() {
    SectionReader reader = section("motor");
    motor_description& motor = device_.description.motor;
    reader.refuse_other_keys(
        {"torque_constant", "max_torque", "amplifier_lag", "slew", "saturation_allowed", "noise"},
        {{"max_current", [&](const EntryDecl& entry) { note_torque(reader, stated_in(entry, dimensions::current)); }}});
    reader.read("torque_constant", due_.force_constant, Bound::above_zero, motor.torque_constant);
    reader.read("max_torque", due_.force, Bound::above_zero, motor.max_torque);
    if (const auto current = reader.stated("max_torque", dimensions::current)) note_torque(reader, current);
    reader.read_within("amplifier_lag", dimensions::time, Bound::zero_or_more, 0, longest_time, "s",
                       motor.amplifier_lag);
    reader.read("slew", due_.force_rate, Bound::above_zero, motor.slew);
    reader.read("saturation_allowed", dimensions::time, Bound::above_zero, motor.saturation_allowed);
    reader.read("noise", due_.force, Bound::zero_or_more, motor.noise);
  }

  // With the torque worked out if the file states both values.
  void note_torque(const SectionReader& reader, const std::optional<double>& current) {
    const auto constant = reader.stated("torque_constant", due_.force_constant);
    diagnostics_.note<DiagnosticCode::torque_of_current>(
        {}, current && constant ? fmt::format(": \"{:.6g} {}\"", *constant * *current, unit_of(due_.force)) : "");
  }

  // A damping stated at the tool is refused, with a note that says its value at the joint.
  void read_damping(const SectionReader& reader, std::string_view key, Bound bound, double& target) const {
    reader.read(key, due_.damping, bound, target);
    const double arm = device_.description.arm_radius;
    const std::optional<double> at_tool = reader.stated(key, dimensions::damping);
    if (motion_ == motion::rotation && arm > 0 && at_tool)
      diagnostics_.note<DiagnosticCode::damping_at_joint>({}, reader.text_of(key), *at_tool * arm * arm);
  }

  void note_damping(const SectionReader& reader, const std::optional<double>& current) {
    std::optional<double> constant = reader.stated("damping_per_current_squared", due_.damping_per_current_squared);
    if (!constant) constant = reader.stated("kappa", due_.damping_per_current_squared);
    diagnostics_.note<DiagnosticCode::damping_of_current>(
        {}, current && constant ? fmt::format(": \"{:.6g} {}\"", *constant * *current * *current, unit_of(due_.damping))
                                : "");
  }

  void read_brake() {
    SectionReader reader = section("brake");
    brake_description& brake = device_.description.brake;
    reader.refuse_other_keys(
        {"kind", "max_damping", "damping_per_current_squared", "residual_damping", "tolerance", "coil_lag", "slew",
         "critical_speed", "safe_damping"},
        {{"max_current", [&](const EntryDecl& entry) { note_damping(reader, stated_in(entry, dimensions::current)); }},
         {"kappa", [&](const EntryDecl&) {
            diagnostics_.note<DiagnosticCode::key_is_called>({}, "damping_per_current_squared");
          }}});
    reader.require("kind");
    reader.require("max_damping");
    if (const auto word = reader.read_word("kind", {"eddy_current", "shorted_motor"}))
      brake.kind = *word == 0 ? brake_kind::eddy_current : brake_kind::shorted_motor;
    read_damping(reader, "max_damping", Bound::above_zero, brake.max_damping);
    if (const auto current = reader.stated("max_damping", dimensions::current)) note_damping(reader, current);
    reader.read("damping_per_current_squared", due_.damping_per_current_squared, Bound::above_zero,
                brake.damping_per_current_squared);
    read_damping(reader, "residual_damping", Bound::zero_or_more, brake.residual_damping);
    reader.read("tolerance", dimensions::number, Bound::zero_or_more, brake.tolerance);
    reader.read_within("coil_lag", dimensions::time, Bound::zero_or_more, 0, longest_time, "s", brake.coil_lag);
    reader.read("slew", dimensions::current_rate, Bound::above_zero, brake.slew);
    reader.read_within("critical_speed", due_.velocity, Bound::above_zero, lowest_speed, highest_speed, speed_unit(),
                       brake.critical_speed);
    read_damping(reader, "safe_damping", Bound::zero_or_more, brake.safe_damping);
    check_brake(reader, brake);
  }

  void check_brake(const SectionReader& reader, const brake_description& brake) {
    // Beyond its corner the coil lets less and less of the commanded damping pass.
    const double corner = 0.5 / (std::numbers::pi * brake.coil_lag);  // [Hz]
    if (const double low = device_.description.loop.band_low; corner < low && brake.coil_lag <= longest_time) {
      diagnostics_.report<DiagnosticCode::coil_below_band>(reader.place_of("coil_lag"), reader.text_of("coil_lag"),
                                                           corner, low);
      diagnostics_.note<DiagnosticCode::coil_lag_remedy>({});
    }
    if (brake.tolerance >= 1)
      diagnostics_.report<DiagnosticCode::tolerance_too_large>(reader.place_of("tolerance"),
                                                               reader.text_of("tolerance"));
    if (brake.max_damping == 0) return;
    if (brake.safe_damping > brake.max_damping) report_above_brake(reader, "safe_damping");
    if (brake.residual_damping > brake.max_damping) report_above_brake(reader, "residual_damping");
  }

  void report_above_brake(const SectionReader& reader, std::string_view key) {
    diagnostics_.report<DiagnosticCode::damping_above_brake>(reader.place_of(key), key, reader.text_of(key),
                                                             reader.text_of("max_damping"));
    diagnostics_.note<DiagnosticCode::given_here>(reader.place_of("max_damping"));
  }

  void read_mechanics() {
    SectionReader reader = section("mechanics");
    mechanics_description& mechanics = device_.description.mechanics;
    reader.refuse_other_keys({"inertia", "damping", "coulomb_friction", "mode", "backlash"});
    reader.read("inertia", due_.inertia, Bound::zero_or_more, mechanics.inertia);
    read_damping(reader, "damping", Bound::zero_or_more, mechanics.damping);
    reader.read("coulomb_friction", due_.force, Bound::zero_or_more, mechanics.coulomb_friction);
    reader.read("backlash", due_.position, Bound::zero_or_more, mechanics.backlash);
    if (reader.has("mode"))
      diagnostics_.report<DiagnosticCode::wrong_type>(reader.place_of("mode"), "mode", "a value", "an object");
    else read_mode(reader, mechanics);
  }

  // Backlash is the dead zone of the mode's spring.
  void read_mode(const SectionReader& around, mechanics_description& mechanics) {
    SectionReader reader = section("mechanics.mode");
    if (!reader.is_present()) {
      if (around.has("backlash")) around.require("mode");
      return;
    }
    reader.refuse_other_keys({"frequency", "damping_ratio", "mass"});
    reader.require("frequency");
    reader.require("mass");
    reader.read_within("frequency", dimensions::frequency, Bound::above_zero, slowest_mode,
                       1 / device_.description.loop.sample_period, "Hz", mechanics.mode.frequency);
    reader.read_within("damping_ratio", dimensions::number, Bound::zero_or_more, 0, 1, "of critical damping",
                       mechanics.mode.damping_ratio);
    const bool has_mass = reader.read("mass", due_.inertia, Bound::above_zero, mechanics.mode.mass);
    if (!has_mass || (around.has("inertia") && mechanics.inertia == 0)) return;
    const double least = mechanics.inertia / smallest_part;
    reader.is_within("mass", mechanics.mode.mass, least, mechanics.inertia * (smallest_part - 1) / smallest_part,
                     motion_ == motion::rotation ? "kg m^2" : "kg");
  }

  void read_assumed() {
    const std::vector<std::string> given = dotted_keys();
    for (const Text& name : decl_.assumed) {
      device_.assumed.push_back(name.text);
      if (std::find(given.begin(), given.end(), name.text) != given.end()) continue;
      diagnostics_.report<DiagnosticCode::assumed_not_given>(name.span, excerpt(name.text));
      if (const auto nearest = nearest_name(name.text, given))
        diagnostics_.note<DiagnosticCode::nearest_name>({}, *nearest);
    }
  }

  std::vector<std::string> dotted_keys() const {
    std::vector<std::string> keys;
    if (decl_.arm_radius) keys.emplace_back("arm_radius");
    for (const SectionDecl& section : decl_.sections)
      for (const EntryDecl& entry : section.entries) keys.push_back(section.name.text + "." + entry.key.text);
    return keys;
  }

  const DeviceDecl& decl_;
  Diagnostics& diagnostics_;
  motion motion_;
  const JointDimensions& due_;
  Device device_;
};

}  // namespace

std::optional<Device> build_device(const DeviceDecl& decl, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  Device device = DeviceBuilder(decl, diagnostics).build();
  if (!decl.complete || diagnostics.error_count() > errors_before) return std::nullopt;
  return device;
}

}  // namespace dashpot::compiler
