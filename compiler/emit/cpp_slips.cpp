#include "emit/cpp_slips.hpp"

#include <fmt/format.h>

#include "emit/cpp_lines.hpp"
#include "emit/cpp_program.hpp"

namespace dashpot::compiler {
namespace {

std::string literal(const UpdateLaw& law, double value) { return cpp_literal(value, law.scalar); }

std::string name_of(const UpdateLaw& law, VariableId id) { return CppStatements::scalar_name(law.variables[id]); }

// As a new object has it.
std::string first_number(const UpdateLaw& law, double value, VariableId tuned) {
  return literal(law, tuned == no_variable ? value : law.variables[tuned].rest_value);
}

// What parameters change is kept, and told by set().
std::string table_name(const std::string& name, bool is_tuned) { return name + (is_tuned ? "_" : ""); }
const char* storage(bool is_tuned) { return is_tuned ? "" : "static constexpr "; }

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

void append_table(const UpdateLaw& law, const Coupling& coupling, std::vector<std::string>& lines) {
  const bool is_tuned = !coupling.tuned.empty();
  lines.push_back("// kind, children, slips, place, first corner, stiffness, compliance, yield force");
  lines.push_back(fmt::format("{}dashpot::slip_node<scalar> {}[{}] = {{", storage(is_tuned),
                              table_name(coupling.name, is_tuned), coupling.nodes.size()));
  for (std::size_t k = 0; k < coupling.nodes.size(); ++k) {
    const slip_node<double>& node = coupling.nodes[k];
    const TunedNode tuned = is_tuned ? coupling.tuned[k] : TunedNode{};
    lines.push_back(fmt::format(
        "    {{dashpot::slip_part::{}, {}, {}, {}, {}, {}, {}, {}, {}}},", part_name(node.kind), node.first_child,
        node.child_count, node.slips, node.place, node.first_corner, first_number(law, node.stiffness, tuned.stiffness),
        first_number(law, node.compliance, tuned.compliance), first_number(law, node.yield, tuned.yield)));
  }
  lines.push_back("};");
}

void append_tables(const UpdateLaw& law, const SlipNetwork& network, std::vector<std::string>& lines) {
  const bool is_tuned = network.tuned.has_value();
  const TunedNetwork tuned = network.tuned.value_or(TunedNetwork{});
  const auto at = [&](const std::vector<VariableId>& all, std::size_t i) { return is_tuned ? all[i] : no_variable; };
  lines.push_back("// ends, lowest and highest force of each slip; inner ends come first, then tool and ground");
  lines.push_back(fmt::format("{}dashpot::slip_link<scalar> {}[{}] = {{", storage(is_tuned),
                              table_name(network.name + "_links", is_tuned), network.slip_count()));
  for (std::size_t k = 0; k < network.links.size(); ++k) {
    const slip_link<double>& link = network.links[k];
    const VariableId yield = at(tuned.yields, k);
    const double lowest = yield == no_variable ? link.lowest : -law.variables[yield].rest_value;
    lines.push_back(fmt::format("    {{{}, {}, {}, {}}},", link.a, link.b, literal(law, lowest),
                                first_number(law, link.highest, yield)));
  }
  lines.push_back("};");
  lines.push_back("// stiffness over one sample between inner ends, to the tool and to the ground [N/m] or [N·m/rad]");
  for (const auto& [what, values, variables] : {std::tuple("between", &network.between, &tuned.between),
                                                std::tuple("to_tool", &network.to_tool, &tuned.to_tool),
                                                std::tuple("to_ground", &network.to_ground, &tuned.to_ground)}) {
    std::string table = fmt::format("{}scalar {}[{}] = {{", storage(is_tuned),
                                    table_name(fmt::format("{}_{}", network.name, what), is_tuned), values->size());
    for (std::size_t i = 0; i < values->size(); ++i)
      table += (i == 0 ? "" : ", ") + first_number(law, (*values)[i], at(*variables, i));
    append(lines, table + "};");
  }
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

void append_step(const UpdateLaw& law, const Statement& statement, const Coupling& coupling, CppStatements& statements,
                 std::vector<std::string>& lines) {
  const std::string& name = coupling.name;
  std::string held;
  for (VariableId id : coupling.held)
    held += (held.empty() ? "" : ", ") + (id == no_variable ? std::string("0") : name_of(law, id));
  append(lines, fmt::format("const scalar {}_held[{}] = {{{}}};", name, coupling.held.size(), held));
  lines.push_back(fmt::format("scalar {}_elongation[{}] = {{}};", name, coupling.elongation.size()));
  lines.push_back(fmt::format("int {}_sign[{}] = {{}};", name, coupling.slips.size()));
  lines.push_back(fmt::format("dashpot::slip_tree_scratch<scalar, {}, {}, {}> {}_scratch;", coupling.nodes.size(),
                              coupling.slips.size(), coupling.corners(), name));
  if (coupling.is_pushed()) lines.push_back(fmt::format("scalar {}_change = 0;", name));
  append(lines, statements.assignment(law.variables[statement.target], 0) +
                    fmt::format(
                        "dashpot::slip_tree<scalar>({4}, {0}_scratch).{1}({2}, {0}_held, {0}_elongation, {0}_sign{3});",
                        name, coupling.is_pushed() ? "push" : "step", statements.expression(statement.value, 0),
                        coupling.is_pushed() ? fmt::format(", {}_change", name) : "",
                        table_name(name, !coupling.tuned.empty())));
  if (coupling.is_pushed())
    lines.push_back(statements.assignment(law.variables[coupling.surface_change], 0) + name + "_change;");
  for (std::size_t i = 0; i < coupling.elongation.size(); ++i)
    if (coupling.elongation[i] != no_variable)
      lines.push_back(statements.assignment(law.variables[coupling.elongation[i]], 0) +
                      fmt::format("{}_elongation[{}];", name, i));
  for (std::size_t i = 0; i < coupling.sign.size(); ++i)
    if (coupling.sign[i] != no_variable)
      lines.push_back(statements.assignment(law.variables[coupling.sign[i]], 0) +
                      fmt::format("static_cast<scalar>({}_sign[{}]);", name, i));
}

void append_step(const UpdateLaw& law, const Statement& statement, const SlipNetwork& network,
                 CppStatements& statements, std::vector<std::string>& lines) {
  const std::string& name = network.name;
  std::string held, sign;
  for (VariableId id : network.held)
    held += (held.empty() ? "" : ", ") + (id == no_variable ? std::string("0") : name_of(law, id));
  for (VariableId id : network.last_sign)
    sign += (sign.empty() ? "" : ", ") + fmt::format("static_cast<int>({})", name_of(law, id));
  append(lines, fmt::format("const scalar {}_held[{}] = {{{}}};", name, network.held.size(), held));
  lines.push_back(fmt::format("scalar {}_moved[{}] = {{}};", name, network.node_count));
  append(lines, fmt::format("int {}_sign[{}] = {{{}}};", name, network.slip_count(), sign));
  lines.push_back(fmt::format("dashpot::slip_network_scratch<scalar, {}> {}_scratch;", network.node_count, name));
  const VariableId through = network.tuned ? network.tuned->through : no_variable;
  const auto table = [&](const char* what) { return table_name(name + what, network.tuned.has_value()); };
  append(lines,
         fmt::format("dashpot::slip_network<scalar> {}_step({}, {}, {{{}, {}, {}, {}}}, {}, {}_scratch.room());", name,
                     table("_links"), network.slip_count(), table("_between"), table("_to_tool"), table("_to_ground"),
                     through == no_variable ? literal(law, network.through) : name_of(law, through), network.node_count,
                     name));
  append(lines, statements.assignment(law.variables[statement.target], 0) +
                    fmt::format("{0}_step.step({1}, {0}_held, {0}_moved, {0}_sign);", name,
                                statements.expression(statement.value, 0)));
  for (std::size_t i = 0; i < network.moved.size(); ++i)
    if (network.moved[i] != no_variable)
      lines.push_back(statements.assignment(law.variables[network.moved[i]], 0) +
                      fmt::format("{}_moved[{}];", name, i));
  for (std::size_t i = 0; i < network.sign.size(); ++i)
    lines.push_back(statements.assignment(law.variables[network.sign[i]], 0) +
                    fmt::format("static_cast<scalar>({}_sign[{}]);", name, i));
}

}  // namespace dashpot::compiler
