#include "law/walk.hpp"

#include <algorithm>

namespace dashpot::compiler {
namespace {

void visit_all(const std::vector<VariableId>& variables, const VisitVariable& visit) {
  for (VariableId variable : variables)
    if (variable != no_variable) visit(variable);
}

// What a solver reads besides the held forces.
struct SolverReads {
  const UpdateLaw& law;
  const VisitVariable& visit;
  void operator()(const Assign&) const {}
  void operator()(const SolveTree& step) const {
    for (const TunedNode& node : law.couplings[step.coupling].tuned)
      visit_all({node.stiffness, node.compliance, node.yield}, visit);
  }
  void operator()(const SolveNetwork& step) const {
    const SlipNetwork& network = law.networks[step.network];
    visit_all(network.last_sign, visit);
    if (!network.tuned) return;
    for (const auto* numbers :
         {&network.tuned->yields, &network.tuned->between, &network.tuned->to_tool, &network.tuned->to_ground})
      visit_all(*numbers, visit);
    visit_all({network.tuned->through}, visit);
  }
};

template <class Visit>
void each_expression(const UpdateLaw& law, const Visit& visit) {
  for (const std::vector<Statement>* program : programs(law))
    for (const Statement& statement : *program) each_expression(law, statement.value, visit);
  for (const std::vector<Statement>* program : {&law.start, &law.rest})
    for (const Statement& statement : *program) each_expression(law, statement.value, visit);
}

}  // namespace

void each_read(const UpdateLaw& law, ExpressionId id, const VisitVariable& visit) {
  each_expression(law, id, [&](const Expression& e) {
    if (facts_of(e.operation).refers_to == Referent::variable) visit(e.variable);
  });
}

void each_read(const UpdateLaw& law, const Statement& statement, const VisitVariable& visit) {
  each_read(law, statement.value, visit);
  visit_solved(law, statement, [&](const SolvedSlips& solved) { visit_all(solved.held, visit); });
  std::visit(SolverReads{law, visit}, statement.step);
}

void each_assigned(const UpdateLaw& law, const Statement& statement, const VisitVariable& visit) {
  visit(statement.target);
  visit_solved(law, statement, [&](const SolvedSlips& solved) {
    each_result(solved, [&](VariableId id, SlipResult, std::size_t) { visit(id); });
  });
}

bool reads(const UpdateLaw& law, const std::vector<Statement>& program, VariableId variable) {
  bool found = false;
  for (const Statement& statement : program)
    each_read(law, statement, [&](VariableId read) { found |= read == variable; });
  return found;
}

std::set<CoefficientId> constants_read(const UpdateLaw& law) {
  std::set<CoefficientId> found;
  each_expression(law, [&](const Expression& e) {
    if (facts_of(e.operation).refers_to == Referent::coefficient) found.insert(e.coefficient);
  });
  return found;
}

Lanes lanes_of_loops(const UpdateLaw& law) {
  Lanes all;
  for (const Variable& variable : law.variables) all.count = std::max(all.count, variable.lanes.count);
  return all;
}

bool uses(const UpdateLaw& law, Operation operation) {
  bool found = false;
  each_expression(law, [&](const Expression& e) { found |= e.operation == operation; });
  return found;
}

}  // namespace dashpot::compiler
