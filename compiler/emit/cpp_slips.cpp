#include "emit/cpp_slips.hpp"

#include <fmt/format.h>

#include <utility>

#include "emit/cpp_lines.hpp"
#include "emit/cpp_program.hpp"
#include "emit/cpp_statements.hpp"
#include "emit/slip_tables.hpp"
#include "law/walk.hpp"

namespace dashpot::compiler {
namespace {

std::string literal(const UpdateLaw& law, double value) { return cpp_literal(value, law.scalar); }

std::string name_of(const UpdateLaw& law, VariableId id) { return CppStatements::scalar_name(law.variables[id]); }

TableWords words_for_tables(std::string storage, std::string suffix,
                            std::function<std::string(double value, VariableId tuned)> number) {
  return {std::move(storage),
          "scalar",
          "dashpot::slip_node<scalar>",
          "dashpot::slip_link<scalar>",
          "dashpot::slip_part::",
          [suffix](const std::string& table) { return table + suffix; },
          std::move(number)};
}

// Made up for the step.
TableWords words_for_local_tables(const UpdateLaw& law, const SolverWords& words) {
  return words_for_tables("const ", "", [&](double value, VariableId tuned) {
    return tuned == no_variable ? literal(law, value) : words.read(tuned);
  });
}

void append_all_tables(const UpdateLaw& law, const TableWords& words, bool tuned, std::vector<std::string>& lines) {
  each_solved(law, [&](const auto& slips) {
    if (is_tuned(slips) == tuned) append_tables(slips, words, lines);
  });
}

// What the solver's table is called where it is used.
template <class Slips>
const char* table_suffix(const Slips& slips, const SolverWords& words) {
  return is_tuned(slips) && !words.makes_tables ? "_" : "";
}

template <class Slips>
void begin_step(const UpdateLaw& law, const Slips& slips, const SolverWords& words, std::vector<std::string>& lines) {
  if (is_tuned(slips) && words.makes_tables) append_tables(slips, words_for_local_tables(law, words), lines);
  append(lines, fmt::format("const scalar {}_held[{}] = {{{}}};", slips.name, slips.held.size(),
                            held_forces(slips, "0", words.read)));
}

void take_results(const SolvedSlips& slips, const char* moved, const SolverWords& words,
                  std::vector<std::string>& lines) {
  each_result_text(
      slips, moved, [](const std::string& sign) { return fmt::format("static_cast<scalar>({})", sign); },
      [&](VariableId target, const std::string& value) { lines.push_back(words.assignment(target, value)); });
}

void append_step(const UpdateLaw& law, VariableId target, const Coupling& coupling, const SolverWords& words,
                 std::vector<std::string>& lines) {
  const std::string& name = coupling.name;
  begin_step(law, coupling, words, lines);
  lines.push_back(fmt::format("scalar {}_elongation[{}] = {{}};", name, coupling.moved.size()));
  lines.push_back(fmt::format("int {}_sign[{}] = {{}};", name, coupling.slip_count()));
  lines.push_back(fmt::format("dashpot::slip_tree_scratch<scalar, {}, {}, {}> {}_scratch;", coupling.nodes.size(),
                              coupling.slip_count(), coupling.corners(), name));
  if (coupling.is_pushed()) lines.push_back(fmt::format("scalar {}_change = 0;", name));
  append(
      lines,
      words.assignment(
          target,
          fmt::format("dashpot::slip_tree<scalar>({0}{1}, {0}_scratch).{2}({3}, {0}_held, {0}_elongation, {0}_sign{4})",
                      name, table_suffix(coupling, words), coupling.is_pushed() ? "push" : "step", words.given,
                      coupling.is_pushed() ? fmt::format(", {}_change", name) : "")));
  take_results(coupling, "elongation", words, lines);
}

void append_step(const UpdateLaw& law, VariableId target, const SlipNetwork& network, const SolverWords& words,
                 std::vector<std::string>& lines) {
  const std::string& name = network.name;
  begin_step(law, network, words, lines);
  std::string sign;
  for (VariableId id : network.last_sign)
    sign += (sign.empty() ? "" : ", ") + fmt::format("static_cast<int>({})", words.read(id));
  lines.push_back(fmt::format("scalar {}_moved[{}] = {{}};", name, network.node_count));
  append(lines, fmt::format("int {}_sign[{}] = {{{}}};", name, network.slip_count(), sign));
  lines.push_back(fmt::format("dashpot::slip_network_scratch<scalar, {}> {}_scratch;", network.node_count, name));
  const VariableId through = network.tuned ? network.tuned->through : no_variable;
  append(lines,
         fmt::format("dashpot::slip_network<scalar> {0}_step({0}_links{1}, {2}, {{{0}_between{1}, {0}_to_tool{1}, "
                     "{0}_to_ground{1}, {3}}}, {4}, {0}_scratch.room());",
                     name, table_suffix(network, words), network.slip_count(),
                     through == no_variable ? literal(law, network.through) : words.read(through), network.node_count));
  append(lines,
         words.assignment(target, fmt::format("{0}_step.step({1}, {0}_held, {0}_moved, {0}_sign)", name, words.given)));
  take_results(network, "moved", words, lines);
}

}  // namespace

void append_constant_tables(const UpdateLaw& law, std::vector<std::string>& lines) {
  const auto number = [&](double value, VariableId) { return literal(law, value); };
  append_all_tables(law, words_for_tables("static constexpr ", "", number), false, lines);
}

void append_kept_tables(const UpdateLaw& law, std::vector<std::string>& lines) {
  // As a new object has them; set() tells others.
  const auto number = [&](double value, VariableId tuned) {
    return literal(law, tuned == no_variable ? value : law.variables[tuned].rest_value);
  };
  append_all_tables(law, words_for_tables("", "_", number), true, lines);
}

void append_tuning(const UpdateLaw& law, std::vector<std::string>& lines) {
  const auto tell = [&](const std::string& place, VariableId tuned, const char* sign = "") {
    if (tuned != no_variable) lines.push_back(fmt::format("{} = {}{};", place, sign, name_of(law, tuned)));
  };
  for (const Coupling& coupling : law.couplings)
    for (std::size_t k = 0; k < coupling.tuned.size(); ++k) {
      const std::string node = fmt::format("{}_[{}]", coupling.name, k);
      tell(node + ".stiffness", coupling.tuned[k].stiffness);
      tell(node + ".compliance", coupling.tuned[k].compliance);
      tell(node + ".yield", coupling.tuned[k].yield);
    }
  for (const SlipNetwork& network : law.networks) {
    if (!network.tuned) continue;
    for (std::size_t k = 0; k < network.links.size(); ++k) {
      tell(fmt::format("{}_links_[{}].lowest", network.name, k), network.tuned->yields[k], "-");
      tell(fmt::format("{}_links_[{}].highest", network.name, k), network.tuned->yields[k]);
    }
    for (const auto& [what, variables] :
         {std::pair("between", &network.tuned->between), std::pair("to_tool", &network.tuned->to_tool),
          std::pair("to_ground", &network.tuned->to_ground)})
      for (std::size_t i = 0; i < variables->size(); ++i)
        tell(fmt::format("{}_{}_[{}]", network.name, what, i), (*variables)[i]);
  }
}

void append_step(const UpdateLaw& law, const Statement& statement, const SolverWords& words,
                 std::vector<std::string>& lines) {
  visit_solved(law, statement, [&](const auto& slips) { append_step(law, statement.target, slips, words, lines); });
}

}  // namespace dashpot::compiler
