#include "emit/fused_step.hpp"

#include <algorithm>

namespace dashpot::compiler {
namespace {

bool reads(const UpdateLaw& law, ExpressionId id, VariableId variable) {
  const Expression& e = law.expressions[id];
  if (e.operation == Operation::read || e.operation == Operation::sum) {
    const VariableId read = e.operation == Operation::sum ? law.expressions[e.left].left : e.left;
    return read == variable;
  }
  if (e.operation == Operation::constant) return false;
  if (e.operation == Operation::pick) return reads(law, e.right, variable);
  if (reads(law, e.left, variable)) return true;
  if (e.operation == Operation::flush) return false;
  return reads(law, e.right, variable) || (e.operation == Operation::where && reads(law, e.condition, variable));
}

bool reads(const UpdateLaw& law, const std::vector<Statement>& program, VariableId variable) {
  return std::any_of(program.begin(), program.end(), [&](const Statement& s) { return reads(law, s.value, variable); });
}

// Whether `id` cannot be finite when `input` is not: ∞ − ∞ and 0 · ∞ are NaN. Guards, clamps and choices may hide it.
bool shows(const UpdateLaw& law, ExpressionId id, VariableId input) {
  const Expression& e = law.expressions[id];
  switch (e.operation) {
    case Operation::read: {
      if (e.left == input) return true;
      const auto assigned =
          std::find_if(law.output.begin(), law.output.end(), [&](const Statement& s) { return s.target == e.left; });
      return assigned != law.output.end() && assigned->coupling == no_coupling && assigned->network == no_coupling &&
             law.variables[e.left].size == 1 && shows(law, assigned->value, input);
    }
    case Operation::add:
    case Operation::subtract:
    case Operation::multiply: return shows(law, e.left, input) || shows(law, e.right, input);
    case Operation::constant:
    case Operation::flush:
    case Operation::clamp:
    case Operation::where:
    case Operation::pick:
    case Operation::sum: return false;
  }
  return false;
}

}  // namespace

bool is_fusable(const UpdateLaw& law) { return law.couplings.empty() && law.networks.empty() && law.lanes == 1; }

std::map<VariableId, VariableId> carried_numbers(const UpdateLaw& law) {
  std::map<VariableId, VariableId> carried;
  for (const Statement& statement : law.keep) {
    const Expression& e = law.expressions[statement.value];
    const bool stays = statement.target == law.last_brake || reads(law, law.output, statement.target) ||
                       reads(law, law.energy, statement.target);
    if (e.operation == Operation::read && !stays) carried[statement.target] = e.left;
  }
  return carried;
}

std::string checked_numbers(const UpdateLaw& law) {
  const Statement& last =
      *std::find_if(law.output.begin(), law.output.end(), [&](const Statement& s) { return s.target == law.force; });
  std::string numbers;
  for (VariableId input : {law.position, law.velocity})
    if (!shows(law, last.value, input)) numbers += law.variables[input].name + ", ";
  return numbers + law.variables[law.force].name;
}

}  // namespace dashpot::compiler
