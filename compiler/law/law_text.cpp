#include "law/law_text.hpp"

#include <fmt/format.h>

#include "law/expression_text.hpp"
#include "law/walk.hpp"

namespace dashpot::compiler {
namespace {

std::string value_text(const UpdateLaw& law, const Statement& statement) {
  Spelling spelling;
  spelling.variable = [&](VariableId id) { return law.variables[id].name; };
  spelling.coefficient = [&](CoefficientId id) { return law.coefficients[id].name; };
  spelling.sum = [&](VariableId id) { return "sum(" + law.variables[id].name + ")"; };
  const std::string value = expression_text(law, statement.value, spelling);
  std::string solver;
  visit_solved(law, statement, [&](const SolvedSlips& solved) { solver = solved.name; });
  return solver.empty() ? value : fmt::format("{}({})", solver, value);
}

std::string name_of_variable(const UpdateLaw& law, VariableId id) {
  return id == no_variable ? "-" : law.variables[id].name;
}

std::string coupling_text(const UpdateLaw& law, const Coupling& coupling) {
  std::string text =
      fmt::format("  {}: slips coupled through blocks, at most {} operations\n", coupling.name, coupling.operations());
  for (const slip_node<double>& node : coupling.nodes) {
    const auto place = static_cast<std::size_t>(node.place);
    if (node.kind == slip_part::block)
      text += fmt::format("    block g {}, from {} to {}\n", node.stiffness,
                          name_of_variable(law, coupling.held[place]), name_of_variable(law, coupling.moved[place]));
    else if (node.kind == slip_part::slip) text += fmt::format("    slip {}\n", node.yield);
    else
      text += fmt::format("    {} of parts {} to {}\n", node.kind == slip_part::series ? "series" : "parallel",
                          node.first_child, node.first_child + node.child_count - 1);
  }
  return text;
}

std::string network_text(const UpdateLaw& law, const SlipNetwork& network) {
  const int nodes = network.node_count;
  const auto end = [&](int i) {
    return i < nodes    ? name_of_variable(law, network.moved[static_cast<std::size_t>(i)])
           : i == nodes ? std::string("tool")
                        : std::string("ground");
  };
  std::string text = fmt::format("  {}: slips coupled through no tree, at most {} patterns, {} operations\n",
                                 network.name, network.patterns(), network.operations());
  for (const slip_link<double>& link : network.links)
    text += fmt::format("    slip from {} to {}, {} to {}\n", end(link.a), end(link.b), link.lowest, link.highest);
  for (int i = 0; i < nodes; ++i) {
    const auto row = static_cast<std::size_t>(i);
    text += fmt::format("    {} from {}: to tool {}, to ground {}", end(i), name_of_variable(law, network.held[row]),
                        network.to_tool[row], network.to_ground[row]);
    for (int j = 0; j < i; ++j)
      text += fmt::format(", to {} {}", end(j),
                          network.between[row * static_cast<std::size_t>(nodes) + static_cast<std::size_t>(j)]);
    text += "\n";
  }
  return text + fmt::format("    tool to ground {}\n", network.through);
}

std::string program_text(const UpdateLaw& law, const char* title, const std::vector<Statement>& program) {
  std::string text = fmt::format("{}\n", title);
  for (const Statement& statement : program) {
    const Variable& target = law.variables[statement.target];
    const std::string places = target.size > 1 ? fmt::format("[{}]", target.size) : "";
    text += fmt::format("  {}{} = {}{}{}\n", target.name, places, value_text(law, statement),
                        statement.purpose.empty() ? "" : "  // ", statement.purpose);
  }
  return text;
}

std::string tunable_text(const TunableTables& tables) {
  std::string text = fmt::format("damping follows {}\n", tables.brake.text);
  for (const Tunable& t : tables.tunables)
    text += fmt::format("tunable {} [{}] {}, {} to {}\n", t.name, t.unit, t.range.value, t.range.min, t.range.max);
  for (const BlockPart& part : tables.parts) {
    if (part.spring != no_index)
      text += fmt::format("part with spring {}\n", tables.spring_names[static_cast<std::size_t>(part.spring)]);
    if (part.kind == PartKind::damper) text += "part with a damper\n";
    if (part.kind == PartKind::mesh)
      text += fmt::format("part of {} nodes and {} edges\n", part.node_count, part.edge_count);
  }
  return text;
}

}  // namespace

std::string to_text(const UpdateLaw& law, const Network& network) {
  const std::string damping =
      law.brake_changes() ? fmt::format("{} to {}", law.damping, law.largest_damping) : fmt::format("{}", law.damping);
  std::string text = fmt::format("law of {}: {}, {} driven, {}, period {} s, damping {}, modes in {} form\n",
                                 network.name, name_of(law.scheme), name_of(law.state_input), name_of(law.scalar),
                                 law.sample_period, damping, name_of(law.mode_form));
  if (law.tunable) text += tunable_text(*law.tunable);
  if (has_loops(law))
    text += fmt::format("  vectors in loops are summed in {} partial sums\n", lanes_of_loops(law).count);
  for (const Coefficient& coefficient : law.coefficients) {
    text += fmt::format("  {} [{}]", coefficient.name, coefficient.unit);
    for (double value : coefficient.values) text += fmt::format(" {}", value);
    text += fmt::format("  // {}\n", coefficient.meaning);
  }
  for (const Coupling& coupling : law.couplings) text += coupling_text(law, coupling);
  for (const SlipNetwork& part : law.networks) text += network_text(law, part);
  for (const GuardInTurn& guard : law.guards)
    text += fmt::format("  {} places of {} a sample, in turn, are zero below {}\n", guard.places,
                        law.variables[guard.state].name, law.flush_threshold);
  return text + program_text(law, "output", law.output) + program_text(law, "keep", law.keep) +
         program_text(law, "update", law.update) + program_text(law, "energy", law.energy) +
         (law.tunable ? program_text(law, "tune", law.tune) + program_text(law, "carry", law.carry) : "");
}

}  // namespace dashpot::compiler
