// What the expressions and statements of a law refer to: the one place that knows their layout.
#pragma once

#include <array>
#include <functional>
#include <set>
#include <span>
#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

inline std::span<const ExpressionId> operands(const Expression& expression) {
  return std::span(expression.operands).first(facts_of(expression.operation).operands);
}

// An expression and all below it, operands after what works on them; nothing of what a call has instead of one.
template <class Visit>
void each_expression(const UpdateLaw& law, ExpressionId id, const Visit& visit) {
  if (id == nothing) return;
  const Expression& expression = law.expressions[id];
  visit(expression);
  for (ExpressionId operand : operands(expression)) each_expression(law, operand, visit);
}

// Those of a statement: its value, or what its call is given.
template <class Visit>
void each_expression(const UpdateLaw& law, const Statement& statement, const Visit& visit) {
  each_expression(law, statement.value, visit);
  if (const auto* call = std::get_if<Call>(&statement.step))
    for (const ExpressionId given : call->given) each_expression(law, given, visit);
}

using VisitVariable = std::function<void(VariableId)>;

// The variables that an expression reads, each as often as it does.
void each_read(const UpdateLaw& law, ExpressionId id, const VisitVariable& visit);
// Those that a statement reads: of its value, and what a solver takes beside it.
void each_read(const UpdateLaw& law, const Statement& statement, const VisitVariable& visit);
// Those that it assigns: its target, and what a solver finds beside it.
void each_assigned(const UpdateLaw& law, const Statement& statement, const VisitVariable& visit);

bool reads(const UpdateLaw& law, const std::vector<Statement>& program, VariableId variable);

// What the programs refer to.
std::set<CoefficientId> constants_read(const UpdateLaw& law);
bool uses(const UpdateLaw& law, Operation operation);

inline std::array<const std::vector<Statement>*, 6> programs(const UpdateLaw& law) {
  return {&law.output, &law.keep, &law.update, &law.energy, &law.tune, &law.carry};
}

// All that set() runs, in its order.
inline std::vector<Statement> set_program(const UpdateLaw& law) {
  std::vector<Statement> all = law.tune;
  all.insert(all.end(), law.carry.begin(), law.carry.end());
  return all;
}

}  // namespace dashpot::compiler
