#include "law/cost.hpp"

#include "law/walk.hpp"

namespace dashpot::compiler {
namespace {

void count(const UpdateLaw& law, const Expression& expression, std::size_t places, Cost& cost) {
  const OperationFacts& facts = facts_of(expression.operation);
  if (expression.operation == Operation::sum) places = law.variables[expression.variable].size - 1;
  cost.additions += places * facts.additions;
  cost.multiplications += places * facts.multiplications;
  cost.selections += places * facts.selections;
  cost.guards += places * facts.guards;
}

}  // namespace

Cost cost_of(const UpdateLaw& law, const std::vector<Statement>& program) {
  Cost cost;
  for (const Statement& statement : program) {
    const std::size_t places = law.variables[statement.target].size;
    each_expression(law, statement.value, [&](const Expression& e) { count(law, e, places, cost); });
    visit_solved(law, statement,
                 [&](const auto& slips) { cost.coupled += static_cast<std::size_t>(slips.operations()); });
  }
  if (&program == &law.update)
    for (const GuardInTurn& guard : law.guards) cost.guards += guard.places;
  for (const Variable& variable : law.variables)
    if (variable.role == Role::state) cost.states += variable.size;
  return cost;
}

std::size_t operations_of(const Cost& cost) {
  return cost.additions + cost.multiplications + cost.selections + cost.guards + cost.coupled;
}

}  // namespace dashpot::compiler
