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

void read_modes(const UpdateLaw& law, std::string_view name, double MotorMode::*member, MotorConstants& motor) {
  const Coefficient* coefficient = find(law, name);
  if (coefficient == nullptr) return;
  motor.modes.resize(coefficient->values.size());
  for (std::size_t i = 0; i < motor.modes.size(); ++i) motor.modes[i].*member = coefficient->values[i];
}

bool has_slips(const UpdateLaw& law) {
  const auto chooses = [](const Expression& e) {
    return e.operation == Operation::clamp || e.operation == Operation::where;
  };
  return law.brake_changes() || !law.couplings.empty() || std::any_of(law.expressions.begin(), law.expressions.end(), chooses);
}

}  // namespace

bool MotorConstants::estimate_drives_modes() const {
  return std::any_of(modes.begin(), modes.end(), [](const MotorMode& mode) { return mode.velocity_drive != 0; });
}

bool MotorConstants::follows_estimate() const { return velocity_gain != 0 || estimate_drives_modes(); }

Rational exact_decay(const MotorConstants& motor, const MotorMode& mode) {
  return motor.loss_is_emitted ? Rational(1) - Rational(mode.loss) : Rational(mode.decay);
}

std::optional<MotorConstants> motor_constants(const UpdateLaw& law) {
  if (has_slips(law) || law.tunable) return std::nullopt;
  MotorConstants motor;
  motor.brake = law.damping;
  motor.static_stiffness = value_of(law, "static_stiffness");
  motor.half_static_stiffness = value_of(law, "half_static_stiffness");
  motor.step_stiffness = value_of(law, "step_stiffness");
  motor.velocity_gain = value_of(law, "velocity_gain");
  motor.loss_is_emitted = find(law, "mode_loss") != nullptr;
  read_modes(law, "mode_decay", &MotorMode::decay, motor);
  read_modes(law, "mode_loss", &MotorMode::loss, motor);
  read_modes(law, "mode_gain", &MotorMode::position_drive, motor);
  read_modes(law, "mode_velocity_drive", &MotorMode::velocity_drive, motor);
  read_modes(law, "mode_energy_weight", &MotorMode::energy_weight, motor);
  for (MotorMode& mode : motor.modes) (motor.loss_is_emitted ? mode.decay : mode.loss) = 1 - (motor.loss_is_emitted ? mode.loss : mode.decay);
  motor.unit_roundoff = unit_roundoff(law.scalar);
  motor.error_bound = law.relative_error_bound;
  return motor;
}

}  // namespace dashpot::compiler
