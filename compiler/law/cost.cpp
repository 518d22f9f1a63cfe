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

struct SolverOperations {
  const UpdateLaw& law;
  int operator()(const Assign&) const { return 0; }
  int operator()(const SolveTree& step) const { return law.couplings[step.coupling].operations(); }
  int operator()(const SolveNetwork& step) const { return law.networks[step.network].operations(); }
};

}  // namespace

Cost cost_of(const UpdateLaw& law, const std::vector<Statement>& program) {
  Cost cost;
  for (const Statement& statement : program) {
    const std::size_t places = law.variables[statement.target].size;
    each_expression(law, statement.value, [&](const Expression& e) { count(law, e, places, cost); });
    cost.coupled += static_cast<std::size_t>(std::visit(SolverOperations{law}, statement.step));
  }
  if (&program == &law.update)
    for (const GuardInTurn& guard : law.guards) cost.guards += guard.places;
  for (const Variable& variable : law.variables)
    if (variable.role == Role::state) cost.states += variable.size;
  return cost;
}

}  // namespace dashpot::compiler
