#include "emit/cpp_statements.hpp"

#include <fmt/format.h>

#include "discretise/expression_text.hpp"
#include "emit/cpp_lines.hpp"
#include "emit/cpp_slips.hpp"

namespace dashpot::compiler {
namespace {

std::string origin_names(const std::vector<std::size_t>& elements, const Network& network) {
  std::string names;
  for (std::size_t i = 0; i < elements.size() && i < 4; ++i)
    names += (i == 0 ? "" : ", ") + network.elements[elements[i]].name;
  return elements.size() > 4 ? fmt::format("{} and {} more", names, elements.size() - 4) : names;
}

}  // namespace

CppStatements::CppStatements(const UpdateLaw& law, const Network& network) : law_(law), network_(network), rolled_(law.lanes > 1) {
  if (!rolled_) return;
  for (const Statement& statement : law.keep) find_vectors(statement.value);
}

std::vector<std::string> CppStatements::lines_of(const std::vector<Statement>& program) {
  std::vector<std::string> lines;
  summed_.clear();
  for (const Statement& statement : program)
    if (law_.variables[statement.target].size == 1) find_sums(statement.value);
  for (std::size_t i = 0; i < program.size();) {
    if (law_.variables[program[i].target].size == 1 || !rolled_) {
      print_unrolled(program[i++], lines);
      continue;
    }
    const std::size_t first = i, size = law_.variables[program[i].target].size;
    while (i < program.size() && law_.variables[program[i].target].size == size) ++i;
    print_loop(program, first, i, lines);
  }
  return lines;
}

void CppStatements::print_unrolled(const Statement& statement, std::vector<std::string>& lines) {
  const Variable& target = law_.variables[statement.target];
  if (!statement.purpose.empty()) lines.push_back("// " + statement.purpose);
  if (statement.coupling != no_coupling) return append_step(law_, statement, law_.couplings[statement.coupling], *this, lines);
  if (statement.network != no_coupling) return append_step(law_, statement, law_.networks[statement.network], *this, lines);
  for (std::size_t place = 0; place < target.size; ++place) {
    const std::string line = assignment(target, place) + expression(statement.value, place) + ";";
    const bool has_origin = target.size > 1 && place < statement.origins.size();
    append(lines, line, has_origin ? origin_names(statement.origins[place], network_) : "");
  }
}

// Elementwise statements in one loop, with the partial sums of those vectors that are added up later.
void CppStatements::print_loop(const std::vector<Statement>& program, std::size_t first, std::size_t last,
                               std::vector<std::string>& lines) {
  for (std::size_t i = first; i < last; ++i) {
    const Variable& target = law_.variables[program[i].target];
    if (outlives_loop(target)) lines.push_back(fmt::format("scalar {}[{}];", target.name, padded(target.size)));
    if (summed_.count(program[i].target) != 0) clear_lane(target, lines);
  }
  lines.push_back(fmt::format("for (int i = 0; i < {}; i += {})", padded_size(program[first]), law_.lanes));
  lines.push_back(fmt::format("  for (int j = 0; j < {}; ++j) {{", law_.lanes));
  for (std::size_t i = first; i < last; ++i) {
    const Variable& target = law_.variables[program[i].target];
    append(lines, "    " + assignment(target, 0) + expression(program[i].value, 0) + ";", program[i].purpose);
  }
  for (std::size_t i = first; i < last; ++i)
    if (const Variable& target = law_.variables[program[i].target]; summed_.count(program[i].target) != 0)
      lines.push_back(fmt::format("    {}[j] += {};", lane(target), vector_name(target, 0)));
  lines.push_back("  }");
}

// One by one: from an empty initialiser a compiler may make a call of memset.
void CppStatements::clear_lane(const Variable& vector, std::vector<std::string>& lines) const {
  lines.push_back(fmt::format("scalar {}[{}];", lane(vector), law_.lanes));
  lines.push_back(fmt::format("for (int j = 0; j < {}; ++j) {}[j] = 0;", law_.lanes, lane(vector)));
}

// Partial sums; called after their vector where a function has several.
std::string CppStatements::lane(const Variable& vector) const { return summed_.size() == 1 ? "lane" : vector.name + "_lane"; }

void CppStatements::find_sums(ExpressionId id) {
  const Expression& e = law_.expressions[id];
  if (e.operation == Operation::sum) summed_.insert(law_.expressions[e.left].left);
  if (e.operation == Operation::read || e.operation == Operation::constant || e.operation == Operation::sum) return;
  find_sums(e.left);
  if (e.operation == Operation::where) find_sums(e.condition);
  if (e.operation != Operation::flush) find_sums(e.right);
}

std::string CppStatements::assignment(const Variable& target, std::size_t place) const {
  const std::string name = target.size == 1 ? scalar_name(target) : vector_name(target, place);
  const bool is_declared = target.role != Role::local || outlives_loop(target);
  return (is_declared ? "" : "const scalar ") + name + " = ";
}

void CppStatements::find_vectors(ExpressionId id) {
  const Expression& e = law_.expressions[id];
  if (e.operation == Operation::read && law_.variables[e.left].size > 1) outliving_.insert(&law_.variables[e.left]);
  if (e.operation == Operation::read || e.operation == Operation::constant) return;
  find_vectors(e.left);
  if (e.operation == Operation::where) find_vectors(e.condition);
  if (e.operation != Operation::flush && e.operation != Operation::sum) find_vectors(e.right);
}

// Of a rolled loop's locals those that are remembered after the command has been found finite need a place each.
bool CppStatements::outlives_loop(const Variable& variable) const {
  return variable.role == Role::local && outliving_.count(&variable) != 0;
}

std::string CppStatements::expression(ExpressionId id, std::size_t place) {
  Spelling spelling;
  spelling.variable = [&](const Variable& variable) {
    return variable.size == 1 ? scalar_name(variable) : vector_name(variable, place);
  };
  spelling.coefficient = [&](const Coefficient& coefficient) {
    used_coefficients_.insert(&coefficient);
    if (coefficient.element_names.empty()) return coefficient.name;
    return is_rolled(coefficient) ? coefficient.name + "[i + j]" : coefficient.element_names[place];
  };
  spelling.flush = [&](const std::string& value) {
    uses_flush_ = true;
    return fmt::format("dashpot::flush_below(threshold, {})", value);
  };
  // A sum is one operand: inside a longer expression its terms keep together.
  const bool is_whole = law_.expressions[id].operation == Operation::sum;
  spelling.clamp = [](const std::string& value, const std::string& limit) {
    return fmt::format("dashpot::clamp_to({}, {})", limit, value);
  };
  spelling.sum = [&](const Variable& vector) {
    const std::string terms = sum_text(vector);
    return is_whole || rolled_ || vector.size == 1 ? terms : "(" + terms + ")";
  };
  return expression_text(law_, id, spelling);
}

std::string CppStatements::sum_text(const Variable& vector) {
  if (rolled_) {
    uses_total_ = true;
    return fmt::format("total({})", lane(vector));
  }
  std::string text;
  for (std::size_t place = 0; place < vector.size; ++place)
    text += (place == 0 ? "" : " + ") + vector_name(vector, place);
  return text;
}

std::string CppStatements::scalar_name(const Variable& variable) {
  const std::string& name = variable.element_names.empty() ? variable.name : variable.element_names.front();
  return variable.role == Role::state ? name + "_" : name;
}

std::string CppStatements::vector_name(const Variable& variable, std::size_t place) const {
  if (rolled_ && outlives_loop(variable)) return variable.name + "[i + j]";
  if (rolled_) return variable.role == Role::state ? variable.name + "_[i + j]" : variable.name;
  return variable.role == Role::state ? variable.element_names[place] + "_" : variable.element_names[place];
}

}  // namespace dashpot::compiler
