#include "discretise/mode_bank.hpp"

#include <algorithm>
#include <functional>

#include "discretise/rounding.hpp"

namespace dashpot::compiler {

ModeBank::ModeBank(LawWriter& writer, const std::vector<Mode>& modes, StateInput input, const Real& sample_period,
                   Names names, std::string prefix, std::vector<Subject> of)
    : writer_(writer),
      modes_(modes),
      names_(std::move(names)),
      prefix_(std::move(prefix)),
      of_(std::move(of)),
      bank_(prefix_.empty() ? port_bank : writer.new_bank()) {
  for (const Mode& mode : modes_)
    coefficients_.push_back(mode_coefficients(mode, writer.law().scheme, input, sample_period));
}

bool ModeBank::follows_position() const {
  return std::any_of(coefficients_.begin(), coefficients_.end(), [](const auto& c) { return c.position_gain != 0; });
}

bool ModeBank::follows_velocity() const {
  return std::any_of(coefficients_.begin(), coefficients_.end(), [](const auto& c) { return c.velocity_gain != 0; });
}

Real ModeBank::step_stiffness() const {
  Real sum = 0;
  for (const ModeCoefficients& mode : coefficients_) sum += mode.position_gain;
  return sum;
}

Real ModeBank::velocity_gain() const {
  Real sum = 0;
  for (const ModeCoefficients& mode : coefficients_) sum += mode.velocity_gain;
  return sum;
}

double ModeBank::smallest_loss() const {
  double smallest = 1;
  for (const ModeCoefficients& mode : coefficients_) smallest = std::min(smallest, to_double(mode.loss));
  return smallest;
}

void ModeBank::declare() {
  if (empty()) return;
  const bool are_several = modes_.size() > 1;
  if (are_several)
    decayed_sum_ = writer_.scalar(joined(prefix_, "relaxed_force"), writer_.force(),
                                  "sum of the modes' forces, decayed to the next sample", Role::state);
  forces_ = state("force", "force of the mode, decayed to the next sample");
  if (!are_several) decayed_sum_ = forces_;
  if (writer_.law().mode_form == ModeForm::compensated)
    errors_ = state("error", "rounding error of the force, carried along");
}

void ModeBank::write_update(VariableId position_change, VariableId velocity) {
  if (empty()) return;
  std::vector<Statement>& update = writer_.law().update;
  const ExpressionId driven = drive(position_change, velocity);
  const std::string decayed = writer_.law().scheme == Scheme::exact ? "a = e^{−λh}" : "a = 1/(1 + λh)";
  switch (writer_.law().mode_form) {
    case ModeForm::product: {
      const ExpressionId decay =
          per_mode(ConstantRole::decay, "decay", "1", decayed.c_str(), [](const auto& c) { return c.decay; });
      // The guard tests the old force, which is there before the sample. The drive comes first in the sum: if a
      // compiler fuses one product with the addition, it is then that of the force.
      writer_.assign(update, forces_, writer_.relax(decay, writer_.read(forces_), driven), "F ← a (F + c Δu)",
                     origins());
      break;
    }
    case ModeForm::delta:
      writer_.assign(update, forces_, writer_.flush(writer_.add(writer_.read(forces_), increment(driven))),
                     "F ← F + (a c Δu − α F)", origins());
      break;
    case ModeForm::compensated: write_compensated(driven);
  }
  if (decayed_sum_ != forces_) writer_.assign(update, decayed_sum_, writer_.sum(forces_), "S = Σ a_i F_i");
}

ExpressionId ModeBank::energy() {
  if (empty()) return nothing;
  // A mode that vanishes within a sample stores nothing from one to the next.
  const Real vanishing = writer_.law().scalar == ScalarType::float64 ? Real("1e-100") : Real("1e-12");
  std::vector<Real> weights;
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    const Real& a = coefficients_[i].decay;
    weights.push_back(a < vanishing ? Real(0) : Real(1 / (2 * modes_[i].stiffness * a * a)));
  }
  const ExpressionId weight = writer_.constants({vector_name(), "energy_weight"}, writer_.compliance(), "1/(2 k a²)",
                                                weights, names_, {ConstantRole::energy_weight, of_, bank_});
  const VariableId stored = state("energy", "", Role::local);
  const ExpressionId squared = writer_.multiply(writer_.multiply(weight, writer_.read(forces_)), writer_.read(forces_));
  writer_.assign(writer_.law().energy, stored, squared, "F²/(2k)", origins());
  return writer_.sum(stored);
}

ExpressionId ModeBank::drive(VariableId position_change, VariableId velocity) {
  ExpressionId sum = nothing;
  if (follows_position()) {
    const ExpressionId gain = per_mode(ConstantRole::gain, "gain", writer_.stiffness(), "a c",
                                       [](const auto& c) { return Real(c.decay * c.position_gain); });
    sum = writer_.multiply(gain, writer_.read(position_change));
  }
  if (!follows_velocity()) return sum;
  const ExpressionId gain = per_mode(ConstantRole::velocity_drive, "velocity_drive", writer_.damping(), "a c h",
                                     [](const auto& c) { return Real(c.decay * c.velocity_gain); });
  return writer_.plus(sum, writer_.multiply(gain, writer_.read(velocity)));
}

ExpressionId ModeBank::increment(ExpressionId driven) {
  const ExpressionId loss =
      per_mode(ConstantRole::loss, "loss", "1", "α = 1 − a", [](const auto& c) { return c.loss; });
  return writer_.subtract(driven, writer_.multiply(loss, writer_.read(forces_)));
}

// y = δ + e; t = F + y; e = y − (t − F); F = t (Kahan)
void ModeBank::write_compensated(ExpressionId driven) {
  std::vector<Statement>& update = writer_.law().update;
  const VariableId added = state("increment", "", Role::local), next = state("next", "", Role::local);
  writer_.assign(update, added, writer_.add(increment(driven), writer_.read(errors_)), "y = (a c Δu − α F) + e",
                 origins());
  writer_.assign(update, next, writer_.add(writer_.read(forces_), writer_.read(added)), "t = F + y");
  const ExpressionId taken = writer_.subtract(writer_.read(next), writer_.read(forces_));
  writer_.assign(update, errors_, writer_.flush(writer_.subtract(writer_.read(added), taken)), "e = y − (t − F)");
  writer_.assign(update, forces_, writer_.flush(writer_.read(next)), "F = t", origins());
}

std::vector<std::vector<std::size_t>> ModeBank::origins() const {
  std::vector<std::vector<std::size_t>> all;
  for (const Mode& mode : modes_) all.push_back(mode.elements);
  return all;
}

template <class ValueOf>
ExpressionId ModeBank::per_mode(ConstantRole role, const char* name, const std::string& unit, const char* meaning,
                                ValueOf value_of) {
  std::vector<Real> values;
  for (const ModeCoefficients& mode : coefficients_) values.push_back(value_of(mode));
  return writer_.constants({vector_name(), name}, unit, meaning, values, names_, {role, of_, bank_});
}

VariableId ModeBank::state(const char* name, const char* meaning, Role role) {
  return writer_.vector({vector_name(), name}, writer_.force(), meaning, role, names_);
}

}  // namespace dashpot::compiler
