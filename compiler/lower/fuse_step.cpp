#include "lower/fuse_step.hpp"

#include <algorithm>

#include "law/walk.hpp"

namespace dashpot::compiler {
namespace {

// Whether `id` is never finite when `input` is not: ∞ − ∞ and 0 · ∞ are NaN. Guards, clamps and choices may hide it.
bool shows(const UpdateLaw& law, ExpressionId id, VariableId input) {
  const Expression& e = law.expressions[id];
  switch (e.operation) {
    case Operation::read: {
      if (e.variable == input) return true;
      const auto assigned = std::find_if(law.output.begin(), law.output.end(),
                                         [&](const Statement& s) { return s.target == e.variable; });
      return assigned != law.output.end() && assigned->assigns() && law.variables[e.variable].size == 1 &&
             shows(law, assigned->value, input);
    }
    case Operation::add:
    case Operation::subtract:
    case Operation::multiply: return shows(law, e.operands[0], input) || shows(law, e.operands[1], input);
    case Operation::relax: return shows(law, e.operands[2], input);
    case Operation::constant:
    case Operation::divide:
    case Operation::square_root:
    case Operation::mean_decay:
    case Operation::flush:
    case Operation::clamp:
    case Operation::where:
    case Operation::pick:
    case Operation::sum: return false;
  }
  return false;
}

}  // namespace

bool is_fusable(const UpdateLaw& law) {
  const auto assigns = [](const Statement& statement) { return statement.assigns(); };
  return !has_loops(law) && std::all_of(law.output.begin(), law.output.end(), assigns) &&
         std::all_of(law.update.begin(), law.update.end(), assigns);
}

std::map<VariableId, VariableId> carried_numbers(const UpdateLaw& law) {
  std::map<VariableId, VariableId> carried;
  for (const Statement& statement : law.keep) {
    const Expression& e = law.expressions[statement.value];
    const bool is_last_brake = law.joints && std::count(law.joints->last_dampings.begin(),
                                                        law.joints->last_dampings.end(), statement.target) > 0;
    const bool stays = is_last_brake || statement.target == law.last_brake || statement.target == law.share ||
                       reads(law, law.output, statement.target) || reads(law, law.energy, statement.target);
    if (e.operation == Operation::read && !stays) carried[statement.target] = e.variable;
  }
  return carried;
}

std::vector<VariableId> checked_numbers(const UpdateLaw& law) {
  if (law.joints) {
    std::vector<VariableId> all;
    for (const auto* some :
         {&law.joints->positions, &law.joints->velocities, &law.joints->dampings, &law.joints->torques})
      all.insert(all.end(), some->begin(), some->end());
    return all;
  }
  const auto last = std::find_if(law.output.begin(), law.output.end(),
                                 [&](const Statement& s) { return s.assigns() && s.target == law.checked(); });
  std::vector<VariableId> numbers;
  for (VariableId input : {law.position, law.velocity})
    if (last == law.output.end() || !shows(law, last->value, input)) numbers.push_back(input);
  numbers.push_back(law.checked());
  return numbers;
}

}  // namespace dashpot::compiler
