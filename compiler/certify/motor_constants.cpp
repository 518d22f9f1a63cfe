#include "certify/motor_constants.hpp"

#include <algorithm>

#include "discretise/rounding.hpp"
#include "law/walk.hpp"

namespace dashpot::compiler {
namespace {

const Coefficient* find(const UpdateLaw& law, ConstantRole role, std::size_t bank = port_bank) {
  const auto found = std::find_if(law.coefficients.begin(), law.coefficients.end(),
                                  [&](const Coefficient& c) { return c.role == role && c.bank == bank; });
  return found == law.coefficients.end() ? nullptr : &*found;
}

double value_of(const UpdateLaw& law, ConstantRole role) {
  const Coefficient* coefficient = find(law, role);
  return coefficient ? coefficient->values.front() : 0;
}

void read_bank(const UpdateLaw& law, std::size_t bank, MotorConstants& motor) {
  motor.loss_is_emitted = find(law, ConstantRole::loss, bank) != nullptr;
  const auto read_modes = [&](ConstantRole role, double MotorMode::*member) {
    const Coefficient* coefficient = find(law, role, bank);
    if (coefficient == nullptr) return;
    motor.modes.resize(coefficient->values.size());
    for (std::size_t i = 0; i < motor.modes.size(); ++i) motor.modes[i].*member = coefficient->values[i];
  };
  read_modes(ConstantRole::decay, &MotorMode::decay);
  read_modes(ConstantRole::loss, &MotorMode::loss);
  read_modes(ConstantRole::gain, &MotorMode::position_drive);
  read_modes(ConstantRole::velocity_drive, &MotorMode::velocity_drive);
  read_modes(ConstantRole::energy_weight, &MotorMode::energy_weight);
  for (MotorMode& mode : motor.modes)
    (motor.loss_is_emitted ? mode.decay : mode.loss) = 1 - (motor.loss_is_emitted ? mode.loss : mode.decay);
  motor.unit_roundoff = unit_roundoff(law.scalar);
  motor.error_bound = law.relative_error_bound;
}

// Whether the statement belongs to the motor's limits or to a static curve's map.
bool is_beside_network(const UpdateLaw& law, const Statement& statement) {
  bool found = false;
  each_expression(law, statement.value, [&](const Expression& e) {
    if (e.operation != Operation::constant && e.operation != Operation::pick) return;
    const ConstantRole role = law.coefficients[e.coefficient].role;
    found |= role == ConstantRole::motor_reach || role == ConstantRole::map;
  });
  return found || (law.sheds() && statement.target == law.force);
}

bool has_slips(const UpdateLaw& law) {
  if ((law.brake_changes() && law.mapped == no_variable) || !law.couplings.empty() || !law.networks.empty() ||
      law.surface_at)
    return true;
  bool chooses = false;  // whether it makes choices other than a motor's limits
  for (const Statement& statement : law.output)
    if (!is_beside_network(law, statement))
      each_expression(law, statement.value, [&](const Expression& e) {
        chooses |= e.operation == Operation::clamp || e.operation == Operation::where;
      });
  return chooses;
}

}  // namespace

bool MotorConstants::estimate_drives_modes() const {
  return std::any_of(modes.begin(), modes.end(), [](const MotorMode& mode) { return mode.velocity_drive != 0; });
}

bool MotorConstants::follows_estimate() const { return velocity_gain != 0 || estimate_drives_modes(); }

MotorConstants position_driven(MotorConstants motor) {
  motor.velocity_gain = 0;
  for (MotorMode& mode : motor.modes) mode.velocity_drive = 0;
  return motor;
}

Rational exact_decay(const MotorConstants& motor, const MotorMode& mode) {
  return motor.loss_is_emitted ? Rational(1) - Rational(mode.loss) : Rational(mode.decay);
}

bool MotorConstants::is_idle() const { return static_stiffness == 0 && velocity_gain == 0 && modes.empty(); }

MotorConstants linear_motor_constants(const UpdateLaw& law) {
  MotorConstants motor;
  motor.static_stiffness = value_of(law, ConstantRole::static_stiffness);
  motor.half_static_stiffness = value_of(law, ConstantRole::half_static_stiffness);
  motor.step_stiffness = value_of(law, ConstantRole::step_stiffness);
  motor.velocity_gain = value_of(law, ConstantRole::velocity_gain);
  read_bank(law, port_bank, motor);
  return motor;
}

std::vector<MotorConstants> parts_behind_slips(const UpdateLaw& law) {
  std::vector<MotorConstants> parts;
  for (const Coefficient& coefficient : law.coefficients) {
    if (coefficient.role != ConstantRole::gain || coefficient.bank == port_bank) continue;
    parts.emplace_back();
    read_bank(law, coefficient.bank, parts.back());
  }
  return parts;
}

std::optional<MotorConstants> motor_constants(const UpdateLaw& law) {
  if (has_slips(law) || law.tunable) return std::nullopt;
  return linear_motor_constants(law);
}

}  // namespace dashpot::compiler
