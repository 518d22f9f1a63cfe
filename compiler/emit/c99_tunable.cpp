#include "emit/c99_tunable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <dashpot/slip_tree.hpp>

#include "emit/c99_parts.hpp"
#include "emit/cpp_lines.hpp"
#include "emit/cpp_program.hpp"
#include "emit/cpp_slips.hpp"
#include "emit/cpp_tunable.hpp"
#include "law/walk.hpp"

namespace dashpot::compiler {
namespace {

using Lines = std::vector<std::string>;

void append_all(Lines& lines, const Lines& more) { lines.insert(lines.end(), more.begin(), more.end()); }

class TablesPrinter {
 public:
  TablesPrinter(const UpdateLaw& law, const std::string& name)
      : law_(law), tables_(*law.tunable), head_(tables_.head), name_(name) {}

  C99Tunables print() const {
    const C99Words words = wording();
    C99Tunables tunables;
    append_all(tunables.before, c99_part("numbers.h", words));
    if (!tables_.couplings.empty()) append_all(tunables.before, c99_part("slip_tree.h", words));
    if (!tables_.graphs.empty()) append_all(tunables.before, c99_part("slip_network.h", words));
    append_all(tunables.before, sizes());
    append_all(tunables.before, c99_part("tunable_types.h", words));
    append_all(tunables.before, tables());
    append_all(tunables.before, c99_part("tunable_states.h", words));
    tunables.states = {fmt::format("{}_tunables law;  // springs, slips and tank", name_)};
    tunables.functions = c99_part("tunable.h", words);
    tunables.begin = {fmt::format("{}_tunable_begin(&self->law);", name_)};
    return tunables;
  }

 private:
  std::string number(double value) const { return cpp_literal(value, law_.scalar); }
  std::string_view scalar() const { return compiler::name_of(law_.scalar); }

  bool has(tunable_kind kind) const {
    return std::any_of(tables_.parts.begin(), tables_.parts.end(),
                       [kind](const tunable_part& part) { return part.kind == kind; });
  }

  C99Words wording() const {
    const bool mesh = has(tunable_kind::mesh), graph = !tables_.graphs.empty(), tree = !tables_.couplings.empty();
    const bool brake = head_.slip_rule.takes_part, contact = head_.contact.is_there;
    const bool is_static = head_.static_spring != no_index, slips = !tables_.yields.empty();
    const auto calls = [this](TunableCall wanted) {
      return std::any_of(law_.tune.begin(), law_.tune.end(), [wanted](const Statement& statement) {
        const auto* call = std::get_if<CallTunable>(&statement.step);
        return call != nullptr && call->call == wanted;
      });
    };
    C99Words words;
    words.name = name_;
    words.scalar = law_.scalar;
    words.has = {{"ROOTS", true},
                 {"DECAYS", uses(law_, Operation::mean_decay)},
                 {"RELAXES", has(tunable_kind::relaxation)},
                 {"MESH", mesh},
                 {"MESHES", mesh || (graph && brake)},
                 {"VISCOSITY", calls(TunableCall::viscosity)},
                 {"STATIC", is_static},
                 {"SLIPS", slips},
                 {"TREE", tree},
                 {"GRAPH", graph},
                 {"STEP", !contact},
                 {"PUSH", contact},
                 {"BRAKE", brake},
                 {"CONTACT", contact},
                 {"LIMITS", law_.sheds()},
                 {"MAP", head_.map.is_there},
                 {"RETURNS", contact && (is_static || !slips)}};
    return words;
  }

  // Room for at least one of each, since C has no empty arrays.
  Lines sizes() const {
    int slips = 0;
    for (const slip_node<double>& node : tables_.nodes) slips = std::max(slips, node.slips);
    const auto room = [](auto count) { return std::max(int(count), 1); };
    const std::vector<std::pair<const char*, int>> all = {
        {"spring_count", head_.spring_count},
        {"springs", room(tables_.springs.size())},
        {"part_count", head_.part_count},
        {"block_count", head_.block_count},
        {"blocks_room", room(tables_.blocks.size())},
        {"mesh_nodes", room(std::max(tables_.mesh_nodes, tables_.ends))},
        {"slips", head_.slip_count},
        {"coupling_count", head_.coupling_count},
        {"tree_nodes_room", room(tables_.nodes.size())},
        {"corners", room(tables_.corners)},
        {"merged", slip_curve_room(room(tables_.yields.size()))},
        {"graph_count", head_.graph_count},
        {"ends_room", room(tables_.ends)},
        {"static_spring", head_.static_spring}};
    Lines lines = {"enum {"};
    for (const auto& [what, size] : all)
      lines.push_back(fmt::format("  {}_{} = {}{}", name_, what, size, what == all.back().first ? "" : ","));
    lines.push_back("};");
    lines.push_back("");
    return lines;
  }

  Lines tables() const {
    Lines lines;
    append_constants(lines);
    list(lines, "range_of_parameter", "ranges", tables_.tunables, [this](const Tunable& t) {
      return fmt::format("{{{}, {}, {}}},  // {} [{}]", number(t.range.value), number(t.range.min), number(t.range.max),
                         t.name, t.unit);
    });
    row(lines, "spring_numbers", tables_.springs);
    list(lines, "part", "parts", tables_.parts, [this](const tunable_part& p) {
      return fmt::format("{{{}_{}, {}, {}, {}, {}, {}, {}, {}, {}, {}}},", name_, name_of(p.kind), p.spring, p.damping,
                         p.share, p.loss, p.first_node, p.node_count, p.first_edge, p.edge_count, int(p.is_loose));
    });
    if (has(tunable_kind::mesh))
      list(lines, "edge", "edges", tables_.edges,
           [](const tunable_edge& e) { return fmt::format("{{{}, {}, {}, {}}},", e.from, e.to, e.spring, e.damping); });
    list(lines, "block_parts", "block_table", tables_.blocks, [this](const tunable_block<double>& b) {
      return fmt::format("{{{}, {}, {}}},", b.first_part, b.part_count, number(b.least_stiffness));
    });
    append_slips(lines);
    lines.push_back("");
    return lines;
  }

  void append_constants(Lines& lines) const {
    std::vector<std::tuple<const char*, double, const char*>> all = {
        {"rate", head_.rate, "1/h [Hz]"},
        {"retention", head_.retention, "what an offset keeps in a sample where the tank pays [1]"},
        {"threshold", head_.threshold, "magnitudes of states below are zero"},
        {"surface_at", head_.contact.at, "where the surface lies unloaded [m]"},
        {"encoder_step", head_.contact.encoder_step, "how far the gap may open before the command lets go [m]"},
        {"hysteresis", head_.slip_rule.hysteresis, "before a slide has ended for the command [m]"},
        {"coil_share", head_.slip_rule.coil_share, "of what is missing from √b, in a sample [1]"},
        {"motor_limit", head_.motor_limit, "of its force; 0: none [N]"},
        {"motor_step", head_.motor_step, "of its change in a period; 0: none [N]"}};
    if (head_.map.is_there) {
      all.emplace_back("largest_change", head_.map.largest_change, "of w while a force is held [m]");
      all.emplace_back("largest_stiffness", head_.map.largest_stiffness, "of the static spring [N/m]");
    }
    for (const auto& [what, value, meaning] : all)
      lines.push_back(fmt::format("static const {} {}_{} = {};  // {}", scalar(), name_, what, number(value), meaning));
  }

  void append_slips(Lines& lines) const {
    const auto ends = [](const tunable_ends& e) { return fmt::format("{{{}, {}}},", e.from, e.to); };
    if (tables_.yields.empty()) return;
    row(lines, "cuts", tables_.cuts);
    list(lines, "yield", "yields", tables_.yields, [this](const tunable_yield<double>& y) {
      return fmt::format("{{{}, {}, {}}},", y.first_cut, y.cut_count, number(y.least));
    });
    if (!tables_.couplings.empty()) {
      list(lines, "coupling", "couplings", tables_.couplings, [](const tunable_coupling& c) {
        return fmt::format("{{{}, {}, {}, {}, {}}},", c.first_node, c.node_count, c.first_block, c.first_slip,
                           c.first_corner);
      });
      list(lines, "node", "tree_nodes", tables_.nodes, [this](const slip_node<double>& n) {
        return fmt::format("{{{}_{}, {}, {}, {}, {}, {}, 0, 0, 0}},", name_, part_name(n.kind), n.first_child,
                           n.child_count, n.slips, n.place, n.first_corner);
      });
    }
    if (tables_.graphs.empty()) return;
    list(lines, "graph", "graphs", tables_.graphs, [](const tunable_graph& g) {
      return fmt::format("{{{}, {}, {}, {}, {}, {}}},", g.end_count, g.link_count, g.first_slip, g.tie_count,
                         g.first_tie, g.first_block);
    });
    list(lines, "ends", "slip_ends", tables_.links, ends);
    list(lines, "ends", "ties", tables_.ties, ends);
  }

  // An entry of zeros where there is none: nothing reads it.
  template <class Entry, class Text>
  void list(Lines& lines, const char* type, const char* what, const std::vector<Entry>& entries, Text text) const {
    lines.push_back(fmt::format("static const {0}_{1} {0}_{2}[{3}] = {{", name_, type, what,
                                std::max<std::size_t>(entries.size(), 1)));
    for (const Entry& entry : entries) lines.push_back("    " + text(entry));
    if (entries.empty()) lines.push_back("    " + text(Entry{}));
    lines.push_back("};");
  }

  void row(Lines& lines, const char* what, const std::vector<int>& entries) const {
    std::string text;
    for (int entry : entries) text += (text.empty() ? "" : ", ") + std::to_string(entry);
    append(lines, fmt::format("static const int {}_{}[{}] = {{{}}};", name_, what,
                              std::max<std::size_t>(entries.size(), 1), entries.empty() ? "0" : text));
  }

  const UpdateLaw& law_;
  const TunableTables& tables_;
  const tunable_tables<double>& head_;
  std::string name_;
};

}  // namespace

C99Tunables c99_tunables(const UpdateLaw& law, const std::string& name) {
  return law.tunable ? TablesPrinter(law, name).print() : C99Tunables{};
}

}  // namespace dashpot::compiler
