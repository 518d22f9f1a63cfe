#include "emit/cpp_statements.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emit/cpp_lines.hpp"
#include "emit/cpp_slips.hpp"
#include "law/expression_text.hpp"
#include "law/walk.hpp"

namespace dashpot::compiler {
namespace {

std::string origin_names(const std::vector<std::size_t>& elements, const Network& network) {
  std::string names;
  for (std::size_t i = 0; i < elements.size() && i < 4; ++i)
    names += (i == 0 ? "" : ", ") + network.elements[elements[i]].name;
  return elements.size() > 4 ? fmt::format("{} and {} more", names, elements.size() - 4) : names;
}

}  // namespace

CppStatements::CppStatements(const UpdateLaw& law, const Network& network, Timing timing)
    : law_(law), network_(network), branch_free_(timing == Timing::constant) {
  for (const Statement& statement : law.keep)
    each_expression(law, statement.value, [&](const Expression& e) {
      if (e.operation == Operation::read && law.variables[e.variable].size > 1)
        outliving_.insert(&law.variables[e.variable]);
    });
}

std::vector<std::string> CppStatements::lines_of(const std::vector<Statement>& program,
                                                 const std::map<VariableId, VariableId>& given) {
  std::vector<std::string> lines;
  given_.clear();
  for (const auto& [copy, original] : given) given_[&law_.variables[copy]] = &law_.variables[original];
  summed_.clear();
  assigned_.clear();
  hoisted_.clear();
  for (const Statement& statement : program) assigned_.insert(statement.target);
  for (const Statement& statement : program)
    if (target(statement).size == 1)
      each_expression(law_, statement.value, [&](const Expression& e) {
        if (e.operation == Operation::sum) summed_.insert(e.variable);
      });
  for (std::size_t i = 0; i < program.size();) {
    if (!target(program[i]).is_rolled()) {
      print_unrolled(program[i++], lines);
      continue;
    }
    const std::size_t first = i, size = target(program[i]).size;
    while (i < program.size() && target(program[i]).size == size) ++i;
    print_loop(program, first, i, lines);
  }
  return lines;
}

std::vector<std::string> CppStatements::kept_lines_of(const std::vector<Statement>& program) {
  masks_states_ = branch_free_;
  std::vector<std::string> lines = lines_of(program);
  masks_states_ = false;
  return lines;
}

std::vector<std::string> CppStatements::lines_of(const std::vector<GuardInTurn>& guards) {
  std::vector<std::string> lines;
  for (const GuardInTurn& guard : guards) {
    const Variable& forces = law_.variables[guard.state];
    const std::string force = fmt::format("vector::at({}, first + j)", array_name(forces));
    std::string value = fmt::format("vector::flush_below(threshold, {})", force);
    if (branch_free_) value = fmt::format("vector::chosen(sampled, {}, {})", value, force);
    lines.push_back(fmt::format("// |F| below the threshold: F ← 0, of {} modes a sample in turn", guard.places));
    if (guard.places <= 4 * forces.lanes.count)
      lines.push_back("DASHPOT_UNROLL");  // code that does not grow with the modes
    lines.push_back(fmt::format("for (int j = 0, first = {}_; j < {}; j += vector::width)", guard.name, guard.places));
    append(lines, fmt::format("  vector::put({}, first + j, {});", array_name(forces), value));
    const std::string taken =
        branch_free_ ? fmt::format("({} & static_cast<int>(sampled))", guard.places) : std::to_string(guard.places);
    lines.push_back(fmt::format("{0}_ += {1};", guard.name, taken));
    lines.push_back(fmt::format("{0}_ = {0}_ < {1} ? {0}_ : 0;", guard.name, forces.lanes.padded(forces.size)));
  }
  return lines;
}

void CppStatements::print_unrolled(const Statement& statement, std::vector<std::string>& lines) {
  const Variable& target = law_.variables[statement.target];
  if (!statement.purpose.empty()) lines.push_back("// " + statement.purpose);
  if (!statement.assigns()) {
    SolverWords words;
    words.read = [this](VariableId id) { return scalar_name(law_.variables[id]); };
    words.assignment = [this](VariableId id, const std::string& value) {
      return assignment(law_.variables[id], 0) + value + ";";
    };
    words.given = expression(statement.value, 0);
    return append_step(law_, statement, words, lines);
  }
  const bool is_masked = masks_states_ && target.role == Role::state;
  for (std::size_t place = 0; place < target.size; ++place) {
    std::string value = expression(statement.value, place);
    if (is_masked)
      value = fmt::format("dashpot::branch_free::chosen(sampled, {}, {})", value, place_name(target, place));
    const std::string line = assignment(target, place) + value + ";";
    const bool has_origin = target.size > 1 && place < statement.origins.size();
    append(lines, line, has_origin ? origin_names(statement.origins[place], network_) : "");
  }
}

// Elementwise statements in one loop, with the partial sums of those vectors that are added up later.
void CppStatements::print_loop(const std::vector<Statement>& program, std::size_t first, std::size_t last,
                               std::vector<std::string>& lines) {
  const std::vector<Statement> body(program.begin() + static_cast<std::ptrdiff_t>(first),
                                    program.begin() + static_cast<std::ptrdiff_t>(last));
  for (const Statement& statement : body) {
    const Variable& vector = target(statement);
    if (outlives_loop(vector))
      lines.push_back(fmt::format("scalar {}[{}];", vector.name, vector.lanes.padded(vector.size)));
    if (summed_.count(statement.target) != 0)
      lines.push_back(fmt::format("dashpot::partial_sums<vector, {}> {};", vector.lanes.count, lane(vector)));
  }
  for (const Statement& statement : body) hoist_scalars(statement.value, lines);
  const Lanes lanes = target(body.front()).lanes;
  lines.push_back(
      fmt::format("for (int i = 0; i < {}; i += {})", lanes.padded(target(body.front()).size), lanes.count));
  lines.push_back("  DASHPOT_UNROLL");
  lines.push_back(fmt::format("  for (int j = i; j < i + {}; j += vector::width) {{", lanes.count));
  for (const Statement& statement : body) {
    const Variable& vector = target(statement);
    if (vector.role == Role::state && reads_of(statement.value, statement.target) > 1) {
      lines.push_back(
          fmt::format("    const vector {} = vector::in_register({});", vector.name, vector_name(vector, 0)));
      in_register_ = &vector;
    }
    std::string value = rolled_expression(statement.value);
    in_register_ = nullptr;
    if (masks_states_ && vector.role == Role::state)
      value = fmt::format("vector::chosen(sampled, {}, {})", value, vector_name(vector, 0));
    append(lines,
           is_array(vector) ? fmt::format("    vector::put({}, j, {});", array_name(vector), value)
                            : fmt::format("    const vector {} = {};", vector.name, value),
           statement.purpose);
  }
  for (const Statement& statement : body)
    if (summed_.count(statement.target) != 0)
      lines.push_back(
          fmt::format("    {}.add(j - i, {});", lane(target(statement)), vector_name(target(statement), 0)));
  lines.push_back("  }");
}

// How often an expression of a loop reads a vector at the loop's place.
int CppStatements::reads_of(ExpressionId id, VariableId vector) const {
  int count = 0;
  each_expression(law_, id,
                  [&](const Expression& e) { count += e.operation == Operation::read && e.variable == vector; });
  return count;
}

// Partial sums; called after their vector where a function has several.
std::string CppStatements::lane(const Variable& vector) const {
  return summed_.size() == 1 ? "lane" : vector.name + "_lane";
}

// A scalar state would be read again in each round: what a round stores might be it, for all that a compiler knows.
void CppStatements::hoist_scalars(ExpressionId id, std::vector<std::string>& lines) {
  each_expression(law_, id, [&](const Expression& e) {
    if (e.operation != Operation::read) return;
    const Variable& variable = law_.variables[e.variable];
    const bool is_steady = variable.role == Role::state && variable.size == 1 && assigned_.count(e.variable) == 0;
    if (is_steady && hoisted_.insert(e.variable).second)
      lines.push_back(fmt::format("const vector {} = {};", variable.name, scalar_name(variable)));
  });
}

std::string CppStatements::assignment(const Variable& target, std::size_t place) const {
  return (target.role == Role::local ? "const scalar " : "") + place_name(target, place) + " = ";
}

std::string CppStatements::place_name(const Variable& variable, std::size_t place) const {
  return variable.size == 1 ? scalar_name(variable) : vector_name(variable, place);
}

// Of a rolled loop's locals those that are remembered after the command has been found finite need a place each.
bool CppStatements::outlives_loop(const Variable& variable) const {
  return variable.role == Role::local && outliving_.count(&variable) != 0;
}

bool CppStatements::is_array(const Variable& vector) const {
  return vector.role != Role::local || outlives_loop(vector);
}

std::string CppStatements::expression(ExpressionId id, std::size_t place) {
  Spelling spelling;
  spelling.language = branch_free_ ? Language::constant_time : Language::cpp;
  spelling.variable = [&](VariableId variable) { return place_name(original(law_.variables[variable]), place); };
  spelling.coefficient = [&](CoefficientId constant) {
    const Coefficient& c = law_.coefficients[constant];
    return c.element_names.empty() ? c.name : c.element_names[place];
  };
  // A sum is one operand: inside a longer expression its terms keep together.
  const bool is_whole = law_.expressions[id].operation == Operation::sum;
  spelling.sum = [&](VariableId summed) {
    const Variable& vector = law_.variables[summed];
    const std::string terms = sum_text(vector);
    return is_whole || vector.is_rolled() || vector.size == 1 ? terms : "(" + terms + ")";
  };
  return expression_text(law_, id, spelling);
}

std::string CppStatements::rolled_expression(ExpressionId id) {
  Spelling spelling;
  spelling.language = Language::vectors;
  spelling.variable = [this](VariableId read) {
    const Variable& variable = law_.variables[read];
    return hoisted_.count(read) != 0 || &variable == in_register_ ? variable.name : place_name(original(variable), 0);
  };
  spelling.coefficient = [this](CoefficientId constant) {
    const Coefficient& c = law_.coefficients[constant];
    return c.element_names.empty() ? c.name : fmt::format("vector::at({}, j)", c.name);
  };
  spelling.sum = [this](VariableId vector) { return sum_text(law_.variables[vector]); };
  return expression_text(law_, id, spelling);
}

std::string CppStatements::sum_text(const Variable& vector) {
  if (vector.is_rolled()) return lane(vector) + ".total()";
  std::string text;
  for (std::size_t place = 0; place < vector.size; ++place)
    text += (place == 0 ? "" : " + ") + vector_name(vector, place);
  return text;
}

std::string CppStatements::scalar_name(const Variable& variable) {
  const std::string& name = variable.element_names.empty() ? variable.name : variable.element_names.front();
  return variable.is_kept() ? name + "_" : name;
}

std::string CppStatements::array_name(const Variable& variable) const {
  return variable.is_kept() ? variable.name + "_" : variable.name;
}

std::string CppStatements::vector_name(const Variable& variable, std::size_t place) const {
  if (variable.is_rolled())
    return is_array(variable) ? fmt::format("vector::at({}, j)", array_name(variable)) : variable.name;
  return variable.is_kept() ? variable.element_names[place] + "_" : variable.element_names[place];
}

}  // namespace dashpot::compiler
