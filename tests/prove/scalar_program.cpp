#include "scalar_program.hpp"

#include <fmt/format.h>

namespace dashpot::testing {

using compiler::Coefficient;
using compiler::UpdateLaw;
using compiler::Variable;

std::string scalar_name(const Variable& variable, std::size_t place) {
  const std::string& name = variable.element_names.empty() ? variable.name : variable.element_names[place];
  return variable.role == compiler::Role::state ? name + "_" : name;
}

std::string scalar_name(const Coefficient& coefficient, std::size_t place) {
  return coefficient.element_names.empty() ? coefficient.name : coefficient.element_names[place];
}

namespace {

std::string plus(const std::string& left, const std::string& right) {
  return left.empty() ? right : right.empty() ? left : "(" + left + " + " + right + ")";
}

// From the first to the last; of a rolled loop partial sums in turn, which then join half by half.
std::string sum_text(const Variable& vector) {
  std::vector<std::string> partial(vector.lanes.count);
  for (std::size_t i = 0; i < vector.size; ++i) {
    std::string& lane = partial[i % partial.size()];
    lane = plus(lane, scalar_name(vector, i));
  }
  for (std::size_t half = partial.size() / 2; half > 0; half /= 2)
    for (std::size_t i = 0; i < half; ++i) partial[i] = plus(partial[i], partial[i + half]);
  return partial.front();
}

}  // namespace

std::vector<ScalarAssignment> scalar_program(const UpdateLaw& law, const std::vector<compiler::Statement>& program) {
  std::vector<ScalarAssignment> assignments;
  for (const compiler::Statement& statement : program) {
    const Variable& target = law.variables[statement.target];
    for (std::size_t place = 0; place < target.size; ++place) {
      compiler::Spelling all;
      all.variable = [&](compiler::VariableId id) {
        const Variable& v = law.variables[id];
        return scalar_name(v, v.size == 1 ? 0 : place);
      };
      all.coefficient = [&](compiler::CoefficientId id) {
        const Coefficient& c = law.coefficients[id];
        return is_table(c) ? c.name : scalar_name(c, c.values.size() == 1 ? 0 : place);
      };
      all.sum = [&](compiler::VariableId id) { return sum_text(law.variables[id]); };
      assignments.push_back({scalar_name(target, place), target.role == compiler::Role::local,
                             compiler::expression_text(law, statement.value, all)});
    }
  }
  return assignments;
}

bool is_table(const Coefficient& coefficient) {
  return coefficient.element_names.empty() && coefficient.values.size() > 1;
}

bool is_straight(const UpdateLaw& law) { return law.couplings.empty() && law.networks.empty() && !law.tunable; }

}  // namespace dashpot::testing
