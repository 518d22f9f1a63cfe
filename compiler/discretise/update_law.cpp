#include "discretise/update_law.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "discretise/expression_text.hpp"

namespace dashpot::compiler {
namespace {

void count(const UpdateLaw& law, ExpressionId id, std::size_t places, Cost& cost) {
  const Expression& expression = law.expressions[id];
  switch (expression.operation) {
    case Operation::read:
    case Operation::constant: return;
    case Operation::add:
    case Operation::subtract: cost.additions += places; break;
    case Operation::multiply: cost.multiplications += places; break;
    case Operation::flush: cost.guards += places; return count(law, expression.left, places, cost);
    case Operation::clamp: cost.selections += places; break;
    case Operation::where:
      cost.selections += places;
      count(law, expression.condition, places, cost);
      break;
    case Operation::pick: cost.selections += places; return count(law, expression.right, places, cost);
    case Operation::sum: cost.additions += law.variables[law.expressions[expression.left].left].size - 1; return;
  }
  count(law, expression.left, places, cost);
  count(law, expression.right, places, cost);
}

const Spelling& plain_spelling() {
  static const Spelling spelling{
      [](const Variable& variable) { return variable.name; },
      [](const Coefficient& coefficient) { return coefficient.name; },
      [](const std::string& value) { return "flush(" + value + ")"; },
      [](const std::string& value, const std::string& limit) { return "clamp(" + value + ", ±" + limit + ")"; },
      [](const Variable& vector) { return "sum(" + vector.name + ")"; },
      [](const Coefficient& table, const std::string& place) { return fmt::format("{}[{}]", table.name, place); }};
  return spelling;
}

std::string value_text(const UpdateLaw& law, const Statement& statement) {
  const std::string value = expression_text(law, statement.value, plain_spelling());
  if (statement.network != no_coupling) return fmt::format("{}({})", law.networks[statement.network].name, value);
  return statement.coupling == no_coupling ? value
                                           : fmt::format("{}({})", law.couplings[statement.coupling].name, value);
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
      text +=
          fmt::format("    block g {}, from {} to {}\n", node.stiffness, name_of_variable(law, coupling.held[place]),
                      name_of_variable(law, coupling.elongation[place]));
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

std::string number_text(const TunableTables& tables, int index) {
  const tunable_number<double>& number = tables.numbers[static_cast<std::size_t>(index)];
  std::string text = fmt::format("{}", number.base);
  for (int i = number.first; i < number.first + number.count; ++i)
    text += " + " + tables.tunables[static_cast<std::size_t>(tables.terms[static_cast<std::size_t>(i)])].name;
  return text;
}

std::string tunable_text(const TunableTables& tables) {
  std::string text = fmt::format("damping follows {}\n", tables.brake);
  for (const Tunable& t : tables.tunables)
    text += fmt::format("tunable {} [{}] {}, {} to {}\n", t.name, t.unit, t.range.value, t.range.min, t.range.max);
  for (std::size_t i = 0; i < tables.springs.size(); ++i)
    text += fmt::format("spring {} {}\n", tables.spring_names[i], number_text(tables, tables.springs[i]));
  for (const tunable_part<double>& part : tables.parts) {
    if (part.spring != no_index)
      text += fmt::format("part with spring {}\n", tables.spring_names[static_cast<std::size_t>(part.spring)]);
    if (part.damping != no_index) text += fmt::format("part with damping {}\n", number_text(tables, part.damping));
    if (part.kind == tunable_kind::mesh)
      text += fmt::format("part of {} nodes and {} edges\n", part.node_count, part.edge_count);
  }
  return text;
}

}  // namespace

std::string_view name_of(ModeForm form) {
  switch (form) {
    case ModeForm::product: return "product";
    case ModeForm::delta: return "delta";
    case ModeForm::compensated: return "compensated";
  }
  return "";
}

Cost cost_of(const UpdateLaw& law, const std::vector<Statement>& program) {
  Cost cost;
  for (const Statement& statement : program) {
    count(law, statement.value, law.variables[statement.target].size, cost);
    if (statement.coupling != no_coupling)
      cost.coupled += static_cast<std::size_t>(law.couplings[statement.coupling].operations());
    if (statement.network != no_coupling)
      cost.coupled += static_cast<std::size_t>(law.networks[statement.network].operations());
  }
  if (&program == &law.update)
    for (const GuardInTurn& guard : law.guards) cost.guards += guard.places;
  for (const Variable& variable : law.variables)
    if (variable.role == Role::state) cost.states += variable.size;
  return cost;
}

void add_steady_damping(UpdateLaw& law, double damping) {
  const auto raise = [&](double& value) {
    value = law.scalar == ScalarType::float64 ? value + damping : double(float(value) + float(damping));
  };
  const auto steady = std::find_if(law.coefficients.begin(), law.coefficients.end(),
                                   [](const Coefficient& c) { return c.name == "steady_damping"; });
  const auto told =
      std::find_if(law.output.begin(), law.output.end(), [&](const Statement& s) { return s.target == law.brake; });
  if (steady != law.coefficients.end()) {
    raise(steady->values.front());
  } else {
    law.coefficients.push_back({"steady_damping", law.variables[law.brake].unit, "of what no slip changes", {damping}});
    law.expressions.push_back({Operation::constant, static_cast<CoefficientId>(law.coefficients.size() - 1)});
    const auto constant = static_cast<ExpressionId>(law.expressions.size() - 1);
    law.expressions.push_back({Operation::add, told->value, constant});
    told->value = constant + 1;
  }
  for (double* value : {&law.damping, &law.largest_damping, &law.variables[law.last_brake].rest_value}) raise(*value);
}

std::string to_text(const UpdateLaw& law, const Network& network) {
  const std::string damping = law.brake_changes() || law.tunable
                                  ? fmt::format("{} to {}", law.damping, law.largest_damping)
                                  : fmt::format("{}", law.damping);
  std::string text = fmt::format("law of {}: {}, {} driven, {}, period {} s, damping {}, modes in {} form\n",
                                 network.name, name_of(law.scheme), name_of(law.state_input), name_of(law.scalar),
                                 law.sample_period, damping, name_of(law.mode_form));
  if (law.tunable) return text + tunable_text(*law.tunable);
  if (law.lanes > 1)
    text += fmt::format("  vectors of {} places and more are summed in {} partial sums\n", law.rolled_from, law.lanes);
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
         program_text(law, "update", law.update) + program_text(law, "energy", law.energy);
}

}  // namespace dashpot::compiler
