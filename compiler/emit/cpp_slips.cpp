#include "emit/cpp_slips.hpp"

#include <fmt/format.h>

#include "emit/cpp_lines.hpp"
#include "emit/cpp_program.hpp"

namespace dashpot::compiler {
namespace {

std::string literal(const UpdateLaw& law, double value) { return cpp_literal(value, law.scalar); }

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

void append_step(const UpdateLaw& law, const Statement& statement, const Coupling& coupling, CppStatements& statements,
                 std::vector<std::string>& lines) {
  const std::string& name = coupling.name;
  std::string held;
  for (VariableId id : coupling.held)
    held += (held.empty() ? "" : ", ") +
            (id == no_variable ? std::string("0") : CppStatements::scalar_name(law.variables[id]));
  append(lines, fmt::format("const scalar {}_held[{}] = {{{}}};", name, coupling.held.size(), held));
  lines.push_back(fmt::format("scalar {}_elongation[{}] = {{}};", name, coupling.elongation.size()));
  lines.push_back(fmt::format("int {}_sign[{}] = {{}};", name, coupling.slips.size()));
  lines.push_back(fmt::format("dashpot::slip_tree_scratch<scalar, {}, {}, {}> {}_scratch;", coupling.nodes.size(),
                              coupling.slips.size(), coupling.corners(), name));
  if (coupling.is_pushed()) lines.push_back(fmt::format("scalar {}_change = 0;", name));
  append(lines, statements.assignment(law.variables[statement.target], 0) +
                    fmt::format(
                        "dashpot::slip_tree<scalar>({0}, {0}_scratch).{1}({2}, {0}_held, {0}_elongation, {0}_sign{3});",
                        name, coupling.is_pushed() ? "push" : "step", statements.expression(statement.value, 0),
                        coupling.is_pushed() ? fmt::format(", {}_change", name) : ""));
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
    held += (held.empty() ? "" : ", ") +
            (id == no_variable ? std::string("0") : CppStatements::scalar_name(law.variables[id]));
  for (VariableId id : network.last_sign)
    sign +=
        (sign.empty() ? "" : ", ") + fmt::format("static_cast<int>({})", CppStatements::scalar_name(law.variables[id]));
  append(lines, fmt::format("const scalar {}_held[{}] = {{{}}};", name, network.held.size(), held));
  lines.push_back(fmt::format("scalar {}_moved[{}] = {{}};", name, network.node_count));
  append(lines, fmt::format("int {}_sign[{}] = {{{}}};", name, network.slip_count(), sign));
  lines.push_back(fmt::format("dashpot::slip_network_scratch<scalar, {}> {}_scratch;", network.node_count, name));
  append(lines, fmt::format("dashpot::slip_network<scalar> {0}_step({0}_links, {1}, {{{0}_between, {0}_to_tool, "
                            "{0}_to_ground, {2}}}, {3}, {0}_scratch.room());",
                            name, network.slip_count(), literal(law, network.through), network.node_count));
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

void append_table(const UpdateLaw& law, const Coupling& coupling, std::vector<std::string>& lines) {
  lines.push_back("// kind, children, slips, place, first corner, stiffness, compliance, yield force");
  lines.push_back(
      fmt::format("static constexpr dashpot::slip_node<scalar> {}[{}] = {{", coupling.name, coupling.nodes.size()));
  for (const slip_node<double>& node : coupling.nodes)
    lines.push_back(fmt::format("    {{dashpot::slip_part::{}, {}, {}, {}, {}, {}, {}, {}, {}}},", part_name(node.kind),
                                node.first_child, node.child_count, node.slips, node.place, node.first_corner,
                                literal(law, node.stiffness), literal(law, node.compliance), literal(law, node.yield)));
  lines.push_back("};");
}

void append_tables(const UpdateLaw& law, const SlipNetwork& network, std::vector<std::string>& lines) {
  lines.push_back("// ends, lowest and highest force of each slip; inner ends come first, then tool and ground");
  lines.push_back(
      fmt::format("static constexpr dashpot::slip_link<scalar> {}_links[{}] = {{", network.name, network.slip_count()));
  for (const slip_link<double>& link : network.links)
    lines.push_back(
        fmt::format("    {{{}, {}, {}, {}}},", link.a, link.b, literal(law, link.lowest), literal(law, link.highest)));
  lines.push_back("};");
  lines.push_back("// stiffness over one sample between inner ends, to the tool and to the ground [N/m] or [N·m/rad]");
  for (const auto& [what, values] : {std::pair("between", &network.between), std::pair("to_tool", &network.to_tool),
                                     std::pair("to_ground", &network.to_ground)}) {
    std::string table = fmt::format("static constexpr scalar {}_{}[{}] = {{", network.name, what, values->size());
    for (std::size_t i = 0; i < values->size(); ++i) table += (i == 0 ? "" : ", ") + literal(law, (*values)[i]);
    append(lines, table + "};");
  }
}

}  // namespace dashpot::compiler
