#include "certify/motor_constants.hpp"

#include <algorithm>

#include "discretise/rounding.hpp"

namespace dashpot::compiler {
namespace {

const Coefficient* find(const UpdateLaw& law, std::string_view name) {
  const auto found = std::find_if(law.coefficients.begin(), law.coefficients.end(),
                                  [&](const Coefficient& coefficient) { return coefficient.name == name; });
  return found == law.coefficients.end() ? nullptr : &*found;
}

double value_of(const UpdateLaw& law, std::string_view name) {
  const Coefficient* coefficient = find(law, name);
  return coefficient ? coefficient->values.front() : 0;
}

void read_modes(const UpdateLaw& law, const std::string& name, double MotorMode::*member, MotorConstants& motor) {
  const Coefficient* coefficient = find(law, name);
  if (coefficient == nullptr) return;
  motor.modes.resize(coefficient->values.size());
  for (std::size_t i = 0; i < motor.modes.size(); ++i) motor.modes[i].*member = coefficient->values[i];
}

// The bank whose constants' names begin with `bank`.
void read_bank(const UpdateLaw& law, const std::string& bank, MotorConstants& motor) {
  motor.loss_is_emitted = find(law, bank + "loss") != nullptr;
  read_modes(law, bank + "decay", &MotorMode::decay, motor);
  read_modes(law, bank + "loss", &MotorMode::loss, motor);
  read_modes(law, bank + "gain", &MotorMode::position_drive, motor);
  read_modes(law, bank + "velocity_drive", &MotorMode::velocity_drive, motor);
  read_modes(law, bank + "energy_weight", &MotorMode::energy_weight, motor);
  for (MotorMode& mode : motor.modes)
    (motor.loss_is_emitted ? mode.decay : mode.loss) = 1 - (motor.loss_is_emitted ? mode.loss : mode.decay);
  motor.unit_roundoff = unit_roundoff(law.scalar);
  motor.error_bound = law.relative_error_bound;
}

bool has_slips(const UpdateLaw& law) {
  const auto chooses = [](const Expression& e) {
    return e.operation == Operation::clamp || e.operation == Operation::where;
  };
  return law.brake_changes() || !law.couplings.empty() || !law.networks.empty() || law.surface_at ||
         std::any_of(law.expressions.begin(), law.expressions.end(), chooses);
}

}  // namespace

bool MotorConstants::estimate_drives_modes() const {
  return std::any_of(modes.begin(), modes.end(), [](const MotorMode& mode) { return mode.velocity_drive != 0; });
}

bool MotorConstants::follows_estimate() const { return velocity_gain != 0 || estimate_drives_modes(); }

Rational exact_decay(const MotorConstants& motor, const MotorMode& mode) {
  return motor.loss_is_emitted ? Rational(1) - Rational(mode.loss) : Rational(mode.decay);
}

bool MotorConstants::is_idle() const { return static_stiffness == 0 && velocity_gain == 0 && modes.empty(); }

MotorConstants linear_motor_constants(const UpdateLaw& law) {
  MotorConstants motor;
  motor.brake = law.damping;
  motor.static_stiffness = value_of(law, "static_stiffness");
  motor.half_static_stiffness = value_of(law, "half_static_stiffness");
  motor.step_stiffness = value_of(law, "step_stiffness");
  motor.velocity_gain = value_of(law, "velocity_gain");
  read_bank(law, "mode_", motor);
  return motor;
}

std::vector<MotorConstants> parts_behind_slips(const UpdateLaw& law) {
  std::vector<MotorConstants> parts;
  for (const Coefficient& coefficient : law.coefficients) {
    if (!coefficient.name.ends_with("_gain")) continue;
    const std::string bank = coefficient.name.substr(0, coefficient.name.size() - std::string_view("gain").size());
    if (bank == "mode_" || (find(law, bank + "decay") == nullptr && find(law, bank + "loss") == nullptr)) continue;
    parts.emplace_back();
    read_bank(law, bank, parts.back());
  }
  return parts;
}

std::optional<MotorConstants> motor_constants(const UpdateLaw& law) {
  if (has_slips(law) || law.tunable) return std::nullopt;
  return linear_motor_constants(law);
}

}  // namespace dashpot::compiler
