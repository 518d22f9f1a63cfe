#include "emit/cpp_tunable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "emit/cpp_lines.hpp"
#include "emit/cpp_program.hpp"
#include "emit/cpp_slips.hpp"

namespace dashpot::compiler {
namespace {

class TablesPrinter {
 public:
  explicit TablesPrinter(const UpdateLaw& law) : law_(law), tables_(*law.tunable) {}

  std::vector<std::string> ranges() const {
    std::vector<std::string> lines;
    list(lines, "dashpot::tunable_range<scalar>", "tunables", tables_.tunables, [this](const Tunable& t, std::size_t) {
      return fmt::format("{{{}, {}, {}}},  // {} [{}]", number(t.range.value), number(t.range.min), number(t.range.max),
                         t.name, t.unit);
    });
    return lines;
  }

  std::vector<std::string> constants() const {
    std::vector<std::string> lines;
    list(lines, "int", "springs", tables_.springs,
         [this](int n, std::size_t i) { return fmt::format("{},  // {}", n, tables_.spring_names[i]); });
    list(lines, "dashpot::tunable_part", "parts", tables_.parts, [this](const tunable_part& p, std::size_t) {
      const std::string remark =
          p.spring == no_index ? "" : "  // " + tables_.spring_names[static_cast<std::size_t>(p.spring)];
      return fmt::format("{{dashpot::tunable_kind::{}, {}, {}, {}, {}, {}, {}, {}, {}, {}}},{}",
                         compiler::name_of(p.kind), p.spring, p.damping, p.share, p.loss, p.first_node, p.node_count,
                         p.first_edge, p.edge_count, p.is_loose, remark);
    });
    list(lines, "dashpot::tunable_edge", "edges", tables_.edges, [](const tunable_edge& e, std::size_t) {
      return fmt::format("{{{}, {}, {}, {}}},", e.from, e.to, e.spring, e.damping);
    });
    list(lines, "dashpot::tunable_block<scalar>", "blocks", tables_.blocks,
         [this](const tunable_block<double>& b, std::size_t) {
           return fmt::format("{{{}, {}, {}}},", b.first_part, b.part_count, number(b.least_stiffness));
         });
    row(lines, "cuts", tables_.cuts);
    list(lines, "dashpot::tunable_yield<scalar>", "yields", tables_.yields,
         [this](const tunable_yield<double>& y, std::size_t) {
           return fmt::format("{{{}, {}, {}}},", y.first_cut, y.cut_count, number(y.least));
         });
    list(lines, "dashpot::tunable_coupling", "couplings", tables_.couplings,
         [](const tunable_coupling& c, std::size_t) {
           return fmt::format("{{{}, {}, {}, {}, {}}},", c.first_node, c.node_count, c.first_block, c.first_slip,
                              c.first_corner);
         });
    append_nodes(lines);
    append_graphs(lines);
    append_head(lines);
    return lines;
  }

 private:
  std::string number(double value) const { return cpp_literal(value, law_.scalar); }

  void append_nodes(std::vector<std::string>& lines) const {
    list(lines, "dashpot::slip_node<scalar>", "nodes", tables_.nodes, [](const slip_node<double>& n, std::size_t) {
      return fmt::format("{{dashpot::slip_part::{}, {}, {}, {}, {}, {}, 0, 0, 0}},", part_name(n.kind), n.first_child,
                         n.child_count, n.slips, n.place, n.first_corner);
    });
  }

  void append_graphs(std::vector<std::string>& lines) const {
    if (tables_.graphs.empty()) return;
    const auto ends = [](const tunable_ends& e, std::size_t) { return fmt::format("{{{}, {}}},", e.from, e.to); };
    list(lines, "dashpot::tunable_graph", "graphs", tables_.graphs, [](const tunable_graph& g, std::size_t) {
      return fmt::format("{{{}, {}, {}, {}, {}, {}}},", g.end_count, g.link_count, g.first_slip, g.tie_count,
                         g.first_tie, g.first_block);
    });
    list(lines, "dashpot::tunable_ends", "links", tables_.links, ends);
    list(lines, "dashpot::tunable_ends", "ties", tables_.ties, ends);
  }

  void append_head(std::vector<std::string>& lines) const {
    const tunable_tables<double>& h = tables_.head;
    lines.push_back("static constexpr dashpot::tunable_tables<scalar> tables = {");
    lines.push_back(
        fmt::format("    {}, {}, {}, {},", number(h.rate), number(h.retention), number(h.threshold), h.static_spring));
    lines.push_back(fmt::format("    {{{}, {}, {}}}, {{{}, {}, {}}},", h.contact.is_there, number(h.contact.at),
                                number(h.contact.encoder_step), h.slip_rule.takes_part, number(h.slip_rule.hysteresis),
                                number(h.slip_rule.coil_share)));
    lines.push_back(fmt::format("    {}, {}, {}, {}, {}, {},", h.spring_count, h.part_count, h.block_count,
                                h.slip_count, h.coupling_count, h.graph_count));
    lines.push_back(fmt::format("    {}, {}, {}, blocks, {}, {}, {}, {}, {},", name_or_none("springs", tables_.springs),
                                name_or_none("parts", tables_.parts), name_or_none("edges", tables_.edges),
                                name_or_none("cuts", tables_.cuts), name_or_none("yields", tables_.yields),
                                name_or_none("couplings", tables_.couplings), name_or_none("nodes", tables_.nodes),
                                tables_.graphs.empty() ? "nullptr, nullptr, nullptr" : "graphs, links, ties"));
    const std::string map =
        fmt::format(", {{true, {}, {}}}", number(h.map.largest_change), number(h.map.largest_stiffness));
    lines.push_back(
        fmt::format("    {}, {}{}}};", number(h.motor_limit), number(h.motor_step), h.map.is_there ? map : ""));
  }

  template <class Entry>
  static std::string name_or_none(const char* name, const std::vector<Entry>& entries) {
    return entries.empty() ? "nullptr" : name;
  }

  template <class Entry, class Text>
  static void list(std::vector<std::string>& lines, const char* type, const char* name,
                   const std::vector<Entry>& entries, Text text) {
    if (entries.empty()) return;
    lines.push_back(fmt::format("static constexpr {} {}[{}] = {{", type, name, entries.size()));
    for (std::size_t i = 0; i < entries.size(); ++i) lines.push_back("    " + text(entries[i], i));
    lines.push_back("};");
  }

  static void row(std::vector<std::string>& lines, const char* name, const std::vector<int>& entries) {
    if (entries.empty()) return;
    std::string text;
    for (int entry : entries) text += (text.empty() ? "" : ", ") + std::to_string(entry);
    lines.push_back(fmt::format("static constexpr int {}[{}] = {{{}}};", name, entries.size(), text));
  }

  const UpdateLaw& law_;
  const TunableTables& tables_;
};

template <class Action>
void each_result(const Statement& statement, const CallTunable& call, Action action) {
  action(statement.target, call.result);
  for (const auto& [result, id] : call.found) action(id, result);
}

}  // namespace

const char* name_of(tunable_kind kind) {
  switch (kind) {
    case tunable_kind::spring: return "spring";
    case tunable_kind::damper: return "damper";
    case tunable_kind::relaxation: return "relaxation";
    case tunable_kind::mesh: return "mesh";
  }
  return "";
}

bool calls_runtime(const UpdateLaw& law) {
  for (const std::vector<Statement>* program : {&law.output, &law.update, &law.energy, &law.tune, &law.rest})
    for (const Statement& statement : *program)
      if (std::holds_alternative<CallTunable>(statement.step)) return true;
  return false;
}

std::vector<std::string> parameters_of(const UpdateLaw& law) {
  if (!law.tunable) return {"struct parameters {};"};
  std::vector<std::string> lines = {"struct parameters {"};
  for (const Tunable& t : law.parameters())
    lines.push_back(fmt::format("  scalar {} = {};  // {} to {} [{}]", t.name, cpp_literal(t.range.value, law.scalar),
                                t.range.min, t.range.max, t.unit));
  lines.push_back("};");
  return lines;
}

std::vector<std::string> taken_values(const UpdateLaw& law) {
  std::vector<std::string> lines = {"unsigned clamped = 0;"};
  const std::vector<Tunable> parameters = law.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    lines.push_back(fmt::format("clamped |= dashpot::take_value(tunables[{0}], wanted.{1}, {2}) << {0};", i,
                                parameters[i].name, CppStatements::scalar_name(law.variables[parameters[i].value])));
  return lines;
}

// What waits for update() belongs to the parameters before.
std::vector<std::string> set_of(const UpdateLaw& law, const std::vector<std::string>& tune) {
  if (!law.tunable)
    return {"// No parameter of this network can be set while it runs.",
            "unsigned set(const parameters&) noexcept { return 0; }"};
  std::vector<std::string> lines = {
      "// Between samples. Injects no energy. Bit i of the result: parameter i was beyond its range and is at its",
      "// bound now, or it was no number and is as it was.", "unsigned set(const parameters& wanted) noexcept {",
      "  update();"};
  for (const std::string& line : taken_values(law)) lines.push_back("  " + line);
  for (const std::string& line : tune) lines.push_back("  " + line);
  for (const char* line : {"  return clamped;", "}"}) lines.push_back(line);
  return lines;
}

void append_tables_of_tunables(const UpdateLaw& law, std::vector<std::string>& lines) {
  if (!law.tunable) return;
  const TablesPrinter printer(law);
  for (std::string& line : printer.ranges()) lines.push_back(std::move(line));
  if (!calls_runtime(law)) return;
  for (std::string& line : printer.constants()) lines.push_back(std::move(line));
}

void append_state_of_tunables(const UpdateLaw& law, std::vector<std::string>& lines) {
  const TunableTables& t = *law.tunable;
  const auto room = [](auto count) { return std::max(static_cast<std::size_t>(count), std::size_t(1)); };
  lines.push_back(fmt::format("dashpot::tunable_law<scalar, {}, {}, {}, {}, {}, {}, {}> law_;", room(t.springs.size()),
                              room(t.mesh_nodes), t.blocks.size(), room(t.nodes.size()), t.yields.size(),
                              room(t.corners), t.ends));
}

namespace {

// Of numbers of the law a list, of others each.
std::string call_text(const CallTunable& call, CppStatements& statements) {
  std::string given;
  for (const ExpressionId id : call.given) given += (given.empty() ? "" : ", ") + statements.expression(id, 0);
  if (takes_numbers(call.call)) given = "{" + given + "}";
  return fmt::format("law_.{}(tables{}{})", compiler::name_of(call.call), given.empty() ? "" : ", ", given);
}

}  // namespace

void append_call(const UpdateLaw& law, const Statement& statement, const CallTunable& call, CppStatements& statements,
                 std::vector<std::string>& lines) {
  const std::string target = statements.assignment(law.variables[statement.target], 0);
  if (call.result == TunableResult::value) return append(lines, target + call_text(call, statements) + ";");
  lines.push_back(fmt::format("const auto& {} = {};", compiler::name_of(call.call), call_text(call, statements)));
  each_result(statement, call, [&](VariableId id, TunableResult result) {
    lines.push_back(fmt::format("{}{}.{};", statements.assignment(law.variables[id], 0), compiler::name_of(call.call),
                                compiler::name_of(result)));
  });
}

void append_initial_values(const UpdateLaw& law, const Statement& statement, const CallTunable& call,
                           CppStatements& statements, std::vector<std::string>& lines) {
  each_result(statement, call, [&](VariableId id, TunableResult result) {
    const Variable& variable = law.variables[id];
    const std::string member = result == TunableResult::value ? "" : fmt::format(".{}", compiler::name_of(result));
    append(lines,
           fmt::format("scalar {} = {}{};", CppStatements::scalar_name(variable), call_text(call, statements), member),
           fmt::format("{} [{}]", variable.meaning, variable.unit));
  });
}

}  // namespace dashpot::compiler
