#include "emit/cpp_slips.hpp"

#include <fmt/format.h>

#include <functional>
#include <tuple>

#include "emit/cpp_lines.hpp"
#include "emit/cpp_program.hpp"
#include "emit/cpp_statements.hpp"

namespace dashpot::compiler {
namespace {

std::string literal(const UpdateLaw& law, double value) { return cpp_literal(value, law.scalar); }

std::string name_of(const UpdateLaw& law, VariableId id) { return CppStatements::scalar_name(law.variables[id]); }

// Where a table stands, and how its numbers are written.
struct TableForm {
  const char* storage;  // before its type
  const char* suffix;   // of its name
  std::function<std::string(double value, VariableId tuned)> number;
};

TableForm form_of_constants(const UpdateLaw& law) {
  return {"static constexpr ", "", [&law](double value, VariableId) { return literal(law, value); }};
}

// As a new object has them; set() tells others.
TableForm form_of_kept(const UpdateLaw& law) {
  return {"", "_", [&law](double value, VariableId tuned) {
            return literal(law, tuned == no_variable ? value : law.variables[tuned].rest_value);
          }};
}

TableForm form_of_local(const UpdateLaw& law, const SolverWords& words) {
  return {"const ", "", [&law, &words](double value, VariableId tuned) {
            return tuned == no_variable ? literal(law, value) : words.read(tuned);
          }};
}

bool is_tuned(const Coupling& coupling) { return !coupling.tuned.empty(); }
bool is_tuned(const SlipNetwork& network) { return network.tuned.has_value(); }

void append_table(const Coupling& coupling, const TableForm& form, std::vector<std::string>& lines) {
  lines.push_back("// kind, children, slips, place, first corner, stiffness, compliance, yield force");
  lines.push_back(fmt::format("{}dashpot::slip_node<scalar> {}{}[{}] = {{", form.storage, coupling.name, form.suffix,
                              coupling.nodes.size()));
  for (std::size_t k = 0; k < coupling.nodes.size(); ++k) {
    const slip_node<double>& node = coupling.nodes[k];
    const TunedNode tuned = is_tuned(coupling) ? coupling.tuned[k] : TunedNode{};
    append(lines, fmt::format("    {{dashpot::slip_part::{}, {}, {}, {}, {}, {}, {}, {}, {}}},", part_name(node.kind),
                              node.first_child, node.child_count, node.slips, node.place, node.first_corner,
                              form.number(node.stiffness, tuned.stiffness),
                              form.number(node.compliance, tuned.compliance), form.number(node.yield, tuned.yield)));
  }
  lines.push_back("};");
}

void append_tables(const SlipNetwork& network, const TableForm& form, std::vector<std::string>& lines) {
  const TunedNetwork tuned = network.tuned.value_or(TunedNetwork{});
  const auto at = [&](const std::vector<VariableId>& all, std::size_t i) {
    return is_tuned(network) ? all[i] : no_variable;
  };
  lines.push_back("// ends, lowest and highest force of each slip; inner ends come first, then tool and ground");
  lines.push_back(fmt::format("{}dashpot::slip_link<scalar> {}_links{}[{}] = {{", form.storage, network.name,
                              form.suffix, network.slip_count()));
  for (std::size_t k = 0; k < network.links.size(); ++k) {
    const slip_link<double>& link = network.links[k];
    const VariableId yield = at(tuned.yields, k);
    const std::string highest = form.number(link.highest, yield);
    const std::string lowest = yield == no_variable ? form.number(link.lowest, yield) : "-" + highest;
    lines.push_back(fmt::format("    {{{}, {}, {}, {}}},", link.a, link.b, lowest, highest));
  }
  lines.push_back("};");
  lines.push_back("// stiffness over one sample between inner ends, to the tool and to the ground [N/m] or [N·m/rad]");
  for (const auto& [what, values, variables] : {std::tuple("between", &network.between, &tuned.between),
                                                std::tuple("to_tool", &network.to_tool, &tuned.to_tool),
                                                std::tuple("to_ground", &network.to_ground, &tuned.to_ground)}) {
    std::string table =
        fmt::format("{}scalar {}_{}{}[{}] = {{", form.storage, network.name, what, form.suffix, values->size());
    for (std::size_t i = 0; i < values->size(); ++i)
      table += (i == 0 ? "" : ", ") + form.number((*values)[i], at(*variables, i));
    append(lines, table + "};");
  }
}

void append_all_tables(const UpdateLaw& law, const TableForm& form, bool tuned, std::vector<std::string>& lines) {
  for (const Coupling& coupling : law.couplings)
    if (is_tuned(coupling) == tuned) append_table(coupling, form, lines);
  for (const SlipNetwork& network : law.networks)
    if (is_tuned(network) == tuned) append_tables(network, form, lines);
}

// What the solver's table is called where it is used.
template <class Slips>
const char* table_suffix(const Slips& slips, const SolverWords& words) {
  return is_tuned(slips) && !words.makes_tables ? "_" : "";
}

std::string held_forces(const std::vector<VariableId>& held, const SolverWords& words) {
  std::string forces;
  for (VariableId id : held) forces += (forces.empty() ? "" : ", ") + (id == no_variable ? "0" : words.read(id));
  return forces;
}

void append_step(const UpdateLaw& law, VariableId target, const Coupling& coupling, const SolverWords& words,
                 std::vector<std::string>& lines) {
  const std::string& name = coupling.name;
  if (is_tuned(coupling) && words.makes_tables) append_table(coupling, form_of_local(law, words), lines);
  append(lines, fmt::format("const scalar {}_held[{}] = {{{}}};", name, coupling.held.size(),
                            held_forces(coupling.held, words)));
  lines.push_back(fmt::format("scalar {}_elongation[{}] = {{}};", name, coupling.elongation.size()));
  lines.push_back(fmt::format("int {}_sign[{}] = {{}};", name, coupling.slips.size()));
  lines.push_back(fmt::format("dashpot::slip_tree_scratch<scalar, {}, {}, {}> {}_scratch;", coupling.nodes.size(),
                              coupling.slips.size(), coupling.corners(), name));
  if (coupling.is_pushed()) lines.push_back(fmt::format("scalar {}_change = 0;", name));
  append(
      lines,
      words.assignment(
          target,
          fmt::format("dashpot::slip_tree<scalar>({0}{1}, {0}_scratch).{2}({3}, {0}_held, {0}_elongation, {0}_sign{4})",
                      name, table_suffix(coupling, words), coupling.is_pushed() ? "push" : "step", words.given,
                      coupling.is_pushed() ? fmt::format(", {}_change", name) : "")));
  if (coupling.is_pushed()) lines.push_back(words.assignment(coupling.surface_change, name + "_change"));
  for (std::size_t i = 0; i < coupling.elongation.size(); ++i)
    if (coupling.elongation[i] != no_variable)
      lines.push_back(words.assignment(coupling.elongation[i], fmt::format("{}_elongation[{}]", name, i)));
  for (std::size_t i = 0; i < coupling.sign.size(); ++i)
    if (coupling.sign[i] != no_variable)
      lines.push_back(words.assignment(coupling.sign[i], fmt::format("static_cast<scalar>({}_sign[{}])", name, i)));
}

void append_step(const UpdateLaw& law, VariableId target, const SlipNetwork& network, const SolverWords& words,
                 std::vector<std::string>& lines) {
  const std::string& name = network.name;
  if (is_tuned(network) && words.makes_tables) append_tables(network, form_of_local(law, words), lines);
  std::string sign;
  for (VariableId id : network.last_sign)
    sign += (sign.empty() ? "" : ", ") + fmt::format("static_cast<int>({})", words.read(id));
  append(lines, fmt::format("const scalar {}_held[{}] = {{{}}};", name, network.held.size(),
                            held_forces(network.held, words)));
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
  for (std::size_t i = 0; i < network.moved.size(); ++i)
    if (network.moved[i] != no_variable)
      lines.push_back(words.assignment(network.moved[i], fmt::format("{}_moved[{}]", name, i)));
  for (std::size_t i = 0; i < network.sign.size(); ++i)
    lines.push_back(words.assignment(network.sign[i], fmt::format("static_cast<scalar>({}_sign[{}])", name, i)));
}

}  // namespace

const char* part_name(slip_part kind) {
  switch (kind) {
    case slip_part::block: return "block";
    case slip_part::slip: return "slip";
    case slip_part::series: return "series";
    case slip_part::parallel: return "parallel";
  }
  return "";
}

void append_constant_tables(const UpdateLaw& law, std::vector<std::string>& lines) {
  append_all_tables(law, form_of_constants(law), false, lines);
}

void append_kept_tables(const UpdateLaw& law, std::vector<std::string>& lines) {
  append_all_tables(law, form_of_kept(law), true, lines);
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
  if (const auto* tree = std::get_if<SolveTree>(&statement.step))
    append_step(law, statement.target, law.couplings[tree->coupling], words, lines);
  if (const auto* network = std::get_if<SolveNetwork>(&statement.step))
    append_step(law, statement.target, law.networks[network->network], words, lines);
}

}  // namespace dashpot::compiler
