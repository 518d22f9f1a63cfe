// What the expressions and statements of a law refer to. Only this file knows their layout.
#pragma once

#include <array>
#include <functional>
#include <set>
#include <span>
#include <vector>

#include "law/update_law.hpp"
#include "network/match.hpp"

namespace dashpot::compiler {

inline std::span<const ExpressionId> operands(const Expression& expression) {
  return std::span(expression.operands).first(facts_of(expression.operation).operands);
}

// Visits an expression and all its operands, each after the one that uses it.
template <class Visit>
void each_expression(const UpdateLaw& law, ExpressionId id, const Visit& visit) {
  const Expression& expression = law.expressions[id];
  visit(expression);
  for (ExpressionId operand : operands(expression)) each_expression(law, operand, visit);
}

// The tables of slips that are solved together, trees first.
template <class Law, class Visit>
void each_solved(Law& law, const Visit& visit) {
  for (auto& tree : law.couplings) visit(tree);
  for (auto& network : law.networks) visit(network);
}

// Visits the table that a statement solves. Out: false, without a visit, if it only assigns.
template <class Visit>
bool visit_solved(const UpdateLaw& law, const Statement& statement, const Visit& visit) {
  return match(
      statement.step, [](const Assign&) { return false; },
      [&](const SolveTree& tree) { return visit(law.couplings[tree.coupling]), true; },
      [&](const SolveNetwork& network) { return visit(law.networks[network.network]), true; });
}

// What a step finds besides the force, if something reads it.
enum class SlipResult {
  surface,  // Δs
  moved,
  sign,
};
// In: visit(variable, kind of result, place in the list of that kind). A surface may also be among the moved parts.
template <class Visit>
void each_result(const SolvedSlips& solved, const Visit& visit) {
  const bool is_among_moved = !solved.moved.empty() && solved.moved.back() == solved.surface;
  if (solved.is_pushed() && !is_among_moved) visit(solved.surface, SlipResult::surface, std::size_t{0});
  for (const auto& [what, list] :
       {std::pair(SlipResult::moved, &solved.moved), std::pair(SlipResult::sign, &solved.sign)})
    for (std::size_t i = 0; i < list->size(); ++i)
      if ((*list)[i] != no_variable) visit((*list)[i], what, i);
}

using VisitVariable = std::function<void(VariableId)>;

// Visits the variables that an expression reads, each as often as it is read.
void each_read(const UpdateLaw& law, ExpressionId id, const VisitVariable& visit);
// Visits those that a statement reads: in its value, and as a solver's further inputs.
void each_read(const UpdateLaw& law, const Statement& statement, const VisitVariable& visit);
// Visits those that it assigns: its target, and a solver's further outputs.
void each_assigned(const UpdateLaw& law, const Statement& statement, const VisitVariable& visit);

bool reads(const UpdateLaw& law, const std::vector<Statement>& program, VariableId variable);

// The constants that the programs refer to.
std::set<CoefficientId> constants_read(const UpdateLaw& law);
bool uses(const UpdateLaw& law, Operation operation);

// The lanes of all its loops, which are alike; 1 if it has none.
Lanes lanes_of_loops(const UpdateLaw& law);
inline bool has_loops(const UpdateLaw& law) { return lanes_of_loops(law).are_there(); }

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
