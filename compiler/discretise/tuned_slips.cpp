#include "discretise/tuned_slips.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "discretise/rounding.hpp"
#include "discretise/tuned_regime.hpp"

namespace dashpot::compiler {
namespace {

std::size_t place(int index) { return static_cast<std::size_t>(index); }

template <class Entry>
std::vector<Entry> part_of(const std::vector<Entry>& all, int first, int count) {
  return {all.begin() + first, all.begin() + first + count};
}

}  // namespace

void TunedSlips::declare() {
  elongations_.assign(blocks_.size(), nothing);
  signs_.assign(tables_.yields.size(), nothing);
  slides_.assign(tables_.yields.size(), nothing);
  for (const TunableCoupling& table : tables_.couplings) declare(table);
  for (const TunableGraph& table : tables_.graphs) declare(table);
  if (!rule_.takes_part) return;
  for (std::size_t k = 0; k < signs_.size() && rule_.hysteresis > 0; ++k)
    memories_.emplace_back(writer_, Real(rule_.hysteresis),
                           [&](const char* what, const std::string& unit, const char* meaning, Role role) {
                             return numbers_.scalar(joined(tables_.slip_names[k], what), unit, meaning, role);
                           });
  if (coil_lags()) root_ = numbers_.scalar("slips_brake_root", "1", "√b of the parts with slips", Role::state);
}

void TunedSlips::declare(const TunableCoupling& table) {
  const std::size_t first_block = place(table.first_block), first_slip = place(table.first_slip);
  std::vector<slip_node<double>> nodes = part_of(tables_.nodes, table.first_node, table.node_count);
  if (const auto path = is_pushed() ? std::nullopt : TunedLoneSlip::path_of(nodes, first_block)) {
    lone_.push_back({TunedLoneSlip(numbers_, blocks_, *path, tables_.slip_names[first_slip]), std::move(nodes),
                     first_block, first_slip});
    return;
  }
  Tree tree{{}, first_block, first_slip};
  Coupling& coupling = tree.coupling;
  coupling.name = writer_.unique(joined("coupled", tables_.slip_names[tree.first_slip]));
  coupling.nodes = std::move(nodes);
  coupling.tuned.resize(coupling.nodes.size());
  for (const slip_node<double>& node : coupling.nodes) {
    if (node.kind == slip_part::block) {
      const std::size_t block = tree.first_block + place(node.place);
      VariableId elongation = no_variable;
      if (block > 0 && blocks_[block].held != nothing)
        elongation = elongations_[block] =
            numbers_.scalar(joined(blocks_[block].name, "stretched"), writer_.length(), "δ of the block", Role::local);
      coupling.moved.push_back(elongation);
      coupling.held.push_back(blocks_[block].held == nothing ? no_variable : blocks_[block].held);
    }
    if (node.kind != slip_part::slip) continue;
    const std::size_t slip = tree.first_slip + place(node.place);
    coupling.slips.push_back(tables_.slip_elements[slip]);
    if (!rule_.takes_part) continue;
    signs_[slip] = numbers_.scalar(joined(tables_.slip_names[slip], "sign"), "1",
                                   "direction in which the slip slides, 0 while it holds", Role::local);
    coupling.sign.push_back(signs_[slip]);
  }
  trees_.push_back(std::move(tree));
}

void TunedSlips::declare(const TunableGraph& table) {
  Graph graph{{}, &table};
  SlipNetwork& network = graph.network;
  const std::size_t first = place(table.first_slip), ends = place(table.end_count);
  network.name = writer_.unique(joined("network", tables_.slip_names[first]));
  network.node_count = table.end_count;
  network.between.assign(ends * ends, 0);
  network.to_tool.assign(ends, 0);
  network.to_ground.assign(ends, 0);
  network.tuned.emplace();
  network.tuned->between.assign(ends * ends, no_variable);
  network.tuned->to_tool.assign(ends, no_variable);
  network.tuned->to_ground.assign(ends, no_variable);
  for (std::size_t i = 0; i + (is_pushed() ? 1 : 0) < ends; ++i)
    network.moved.push_back(numbers_.scalar(joined(network.name, fmt::format("end_{}_moved", i + 1)), writer_.length(),
                                            "displacement of an inner end", Role::local));
  const auto add_sign = [&](const std::string& name) {
    const VariableId sign =
        numbers_.scalar(joined(name, "sign"), "1", "direction in which the slip slides, 0 while it holds", Role::local);
    network.sign.push_back(sign);
    network.last_sign.push_back(writer_.kept(sign));
    return sign;
  };
  for (std::size_t k = first; k < first + place(table.link_count); ++k) {
    network.links.push_back({tables_.links[k].from, tables_.links[k].to, -1, 1});
    network.tuned->yields.push_back(no_variable);
    signs_[k] = add_sign(tables_.slip_names[k]);
  }
  if (is_pushed()) {
    network.links.push_back({table.end_count, table.end_count - 1, 0, largest_finite(writer_.law().scalar)});
    network.tuned->yields.push_back(no_variable);
    add_sign("surface");
  }
  graphs_.push_back(std::move(graph));
}

void TunedSlips::tune(const std::vector<ExpressionId>& numbers) {
  for (Lone& lone : lone_) tune(lone, numbers);
  for (Tree& tree : trees_) tune(tree, numbers);
  for (Graph& graph : graphs_) tune(graph, numbers);
}

void TunedSlips::tune(Lone& lone, const std::vector<ExpressionId>& numbers) {
  std::vector<ExpressionId> stiffness;
  for (const TunedLoneSlip::Level& level : lone.step.path()) stiffness.push_back(bounded_stiffness(level.block));
  const ExpressionId yield = yield_of(lone.slip, numbers);
  lone.step.tune(stiffness,
                 numbers_.tuned(joined(tables_.slip_names[lone.slip], "yield"), writer_.force(), "Y", yield));
}

// With every slip giving way: of a block g, of a slip 0, in parallel the sum, in series the inverse of Σ 1/g.
void TunedSlips::tune(Tree& tree, const std::vector<ExpressionId>& numbers) {
  Coupling& coupling = tree.coupling;
  std::vector<ExpressionId> stiffness(coupling.nodes.size()), compliance(coupling.nodes.size());
  for (std::size_t k = coupling.nodes.size(); k-- > 0;) {
    slip_node<double>& node = coupling.nodes[k];
    if (node.kind == slip_part::slip)
      tune_yield(tree.first_slip + place(node.place), numbers, node.yield, coupling.tuned[k].yield);
    else tune_end(tree, k, stiffness, compliance);
  }
}

void TunedSlips::tune_end(Tree& tree, std::size_t k, std::vector<ExpressionId>& stiffness,
                          std::vector<ExpressionId>& compliance) {
  const slip_node<double>& node = tree.coupling.nodes[k];
  ExpressionId sum = nothing, inverse = nothing, is_stiff = nothing;
  bool is_flat = false;
  std::string name = joined(tree.coupling.name, fmt::format("part_{}", k));
  if (node.kind == slip_part::block) {
    const std::size_t block = tree.first_block + place(node.place);
    name = blocks_[block].name;
    sum = bounded_stiffness(block);
  }
  for (std::size_t i = place(node.first_child); i < place(node.first_child + node.child_count); ++i) {
    is_flat = is_flat || stiffness[i] == nothing;
    if (stiffness[i] == nothing) continue;
    sum = writer_.plus(sum, stiffness[i]);
    inverse = writer_.plus(inverse, compliance[i]);
    is_stiff = is_stiff == nothing ? stiffness[i] : writer_.where(is_stiff, stiffness[i], numbers_.zero());
  }
  const bool is_series = node.kind == slip_part::series;
  if (sum == nothing || (is_series && is_flat)) return;
  if (is_series) sum = writer_.where(is_stiff, writer_.divide(numbers_.one(), inverse), numbers_.zero());
  TunedNode& tuned = tree.coupling.tuned[k];
  tuned.stiffness =
      numbers_.told(joined(name, "answer"), writer_.stiffness(), "g of the part while its slips give way", sum);
  stiffness[k] = writer_.read(tuned.stiffness);
  tuned.compliance =
      numbers_.told(joined(name, "give"), writer_.compliance(), "1/g of that part",
                    writer_.where(stiffness[k], writer_.divide(numbers_.one(), stiffness[k]), numbers_.zero()));
  compliance[k] = writer_.read(tuned.compliance);
}

// The least of all ways to cut through a slip.
ExpressionId TunedSlips::yield_of(std::size_t slip, const std::vector<ExpressionId>& numbers) {
  const TunableYield& yield = tables_.yields[slip];
  ExpressionId weakest = nothing;
  for (int i = yield.first_cut; i < yield.first_cut + yield.cut_count; ++i) {
    const ExpressionId cut = numbers[place(tables_.cuts[place(i)])];
    weakest = weakest == nothing ? cut : least_of(cut, weakest);
  }
  const ExpressionId least = numbers_.constant(joined(tables_.slip_names[slip], "least_yield"), writer_.force(),
                                               "smallest Y, whatever the parameters are", yield.least,
                                               {ConstantRole::least_yield, OfTablePlace{slip}});
  return largest_of(weakest, least);
}

void TunedSlips::tune_yield(std::size_t slip, const std::vector<ExpressionId>& numbers, double& constant,
                            VariableId& tuned) {
  const ExpressionId found = yield_of(slip, numbers);
  if (const std::optional<double> fixed = constant_in(found)) constant = *fixed;
  else tuned = numbers_.told(joined(tables_.slip_names[slip], "yield"), writer_.force(), "Y", found);
}

std::optional<double> TunedSlips::constant_in(ExpressionId value) const {
  const Expression& e = writer_.law().expressions[value];
  if (e.operation != Operation::constant) return std::nullopt;
  return writer_.law().coefficients[e.coefficient].values.front();
}

// Next to a part without stiffness the curves of slips would lose their digits, so g is kept above a small bound. A
// block whose g is raised acts as if it had a little more damping.
ExpressionId TunedSlips::bounded_stiffness(std::size_t block) {
  const std::string& name = blocks_[block].name;
  const ExpressionId g = blocks_[block].stiffness;
  const ExpressionId least =
      numbers_.constant(joined(name, "least_answer"), writer_.stiffness(), "smallest g, whatever the parameters are",
                        tables_.blocks[block].least_stiffness, {ConstantRole::least_stiffness, OfTablePlace{block}});
  return g == nothing ? least : largest_of(g, least);
}

void TunedSlips::tune(Graph& graph, const std::vector<ExpressionId>& numbers) {
  SlipNetwork& network = graph.network;
  const TunableGraph& table = *graph.table;
  for (std::size_t k = 0; k < place(table.link_count); ++k) {
    double yield = 1;
    tune_yield(place(table.first_slip) + k, numbers, yield, network.tuned->yields[k]);
    network.links[k].lowest = -yield, network.links[k].highest = yield;
  }
  const auto ends = place(table.end_count);
  std::vector<ExpressionId> between(ends * ends, nothing), to_tool(ends, nothing), to_ground(ends, nothing);
  ExpressionId through = nothing;
  for (int i = 0; i < table.tie_count; ++i) {
    const TunableEnds& tie = tables_.ties[place(table.first_tie + i)];
    const ExpressionId g = bounded_stiffness(place(table.first_block + i));
    const std::size_t first = place(std::min(tie.from, tie.to)), second = place(std::max(tie.from, tie.to));
    ExpressionId& sum = second < ends    ? between[first * ends + second]
                        : first >= ends  ? through
                        : second == ends ? to_tool[first]
                                         : to_ground[first];
    sum = writer_.plus(sum, g);
  }
  const auto tell = [&](ExpressionId sum, const std::string& what) {
    return sum == nothing ? VariableId(no_variable)
                          : numbers_.told(joined(network.name, what), writer_.stiffness(), "g between two ends", sum);
  };
  for (std::size_t a = 0; a < ends; ++a) {
    for (std::size_t b = a + 1; b < ends; ++b)
      network.tuned->between[a * ends + b] = network.tuned->between[b * ends + a] =
          tell(between[a * ends + b], fmt::format("{}_to_{}", a + 1, b + 1));
    network.tuned->to_tool[a] = tell(to_tool[a], fmt::format("{}_to_tool", a + 1));
    network.tuned->to_ground[a] = tell(to_ground[a], fmt::format("{}_to_ground", a + 1));
  }
  network.tuned->through = tell(through, "tool_to_ground");
}

void TunedSlips::write_step(VariableId force, ExpressionId change) {
  change_ = writer_.reads(change);
  const bool is_alone = lone_.size() + trees_.size() + graphs_.size() == 1;
  ExpressionId sum = nothing;
  const auto part = [&](const std::string& name) {
    if (is_alone) return force;
    const VariableId own = numbers_.scalar(joined(name, "force"), writer_.force(), "force of these slips", Role::local);
    sum = writer_.plus(sum, writer_.read(own));
    return own;
  };
  for (Lone& lone : lone_)
    slides_[lone.slip] = lone.step.write_step(part(joined(tables_.slip_names[lone.slip], "part")), change);
  for (Tree& tree : trees_) write_tree(tree, part(tree.coupling.name), change, no_variable);
  for (Graph& graph : graphs_) write_graph(graph, part(graph.network.name), change, no_variable);
  if (!is_alone) numbers_.assign(force, sum, "σ, force of all slips");
}

void TunedSlips::write_push(VariableId force, ExpressionId approach, VariableId surface_change) {
  change_ = surface_change;
  if (!graphs_.empty()) write_graph(graphs_.front(), force, approach, surface_change);
  else write_tree(trees_.front(), force, approach, surface_change);
}

void TunedSlips::write_tree(Tree& tree, VariableId force, ExpressionId change, VariableId surface_change) {
  tree.coupling.surface = surface_change;
  numbers_.assign(force, change, "slip_tree: f, and δ of every block");
  numbers_.last().step = SolveTree{writer_.law().couplings.add(tree.coupling)};
}

void TunedSlips::write_graph(Graph& graph, VariableId force, ExpressionId change, VariableId surface_change) {
  SlipNetwork& network = graph.network;
  network.surface = surface_change;
  if (network.is_pushed()) network.moved.push_back(surface_change);
  std::vector<ExpressionId> held(place(network.node_count) + 2, nothing);
  for (int i = 0; i < graph.table->tie_count; ++i) {
    const TunableEnds& tie = tables_.ties[place(graph.table->first_tie + i)];
    const VariableId of_block = blocks_[place(graph.table->first_block + i)].held;
    if (of_block == nothing) continue;
    ExpressionId &from = held[place(tie.from)], &to = held[place(tie.to)];
    from = writer_.plus(from, writer_.read(of_block));
    to = writer_.subtract(to == nothing ? numbers_.zero() : to, writer_.read(of_block));
  }
  for (std::size_t i = 0; i <= place(network.node_count); ++i) {
    if (held[i] == nothing) {
      network.held.push_back(no_variable);
      continue;
    }
    const std::string end = i < place(network.node_count) ? fmt::format("end_{}_held", i + 1) : "tool_held";
    network.held.push_back(
        numbers_.scalar(joined(network.name, end), writer_.force(), "force at the end if no end moves", Role::local));
    numbers_.assign(network.held.back(), held[i], "");
  }
  numbers_.assign(force, change, "slip_network: f, and how far every end moves");
  numbers_.last().step = SolveNetwork{writer_.law().networks.add(network)};
}

ExpressionId TunedSlips::damping_of(const std::vector<ExpressionId>& slides, const std::string& prefix) {
  std::vector<ExpressionId> damping;
  for (std::size_t i = 0; i < blocks_.size(); ++i)  // the brake's command has the dampers of block 0 already
    damping.push_back(i == 0 ? ExpressionId(nothing) : blocks_[i].feedthrough);
  ExpressionId sum = nothing;
  for (const Lone& lone : lone_) {
    TunedRegime regime(numbers_,
                       part_of(damping, static_cast<int>(lone.first_block), static_cast<int>(lone.step.path().size())),
                       {slides[lone.slip]});
    sum = writer_.plus(sum, regime.of_tree(lone.nodes, joined(prefix, tables_.slip_names[lone.slip])));
  }
  for (const Tree& tree : trees_) {
    const int blocks = static_cast<int>(tree.coupling.held.size()), slips = tree.coupling.slip_count();
    TunedRegime regime(numbers_, part_of(damping, static_cast<int>(tree.first_block), blocks),
                       part_of(slides, static_cast<int>(tree.first_slip), slips));
    sum = writer_.plus(sum, regime.of_tree(tree.coupling.nodes, joined(prefix, tree.coupling.name)));
  }
  for (const Graph& graph : graphs_) {
    const TunableGraph& table = *graph.table;
    TunedRegime regime(numbers_, part_of(damping, table.first_block, table.tie_count),
                       part_of(slides, table.first_slip, table.link_count));
    const int of_tool = is_pushed() ? table.end_count - 1 : table.end_count;
    sum = writer_.plus(
        sum, regime.of_graph(table.end_count, of_tool, part_of(tables_.ties, table.first_tie, table.tie_count),
                             part_of(tables_.links, table.first_slip, table.link_count),
                             joined(prefix, graph.network.name)));
  }
  return sum;
}

void TunedSlips::write_brake(const Brake& found, VariableId position, ExpressionId left) {
  std::vector<ExpressionId> slides = slides_;
  for (std::size_t k = 0; k < slides.size(); ++k)
    if (slides[k] == nothing) slides[k] = writer_.multiply(writer_.read(signs_[k]), writer_.read(signs_[k]));
  const ExpressionId now = numbers_.named("slips_damping_now", writer_.damping(),
                                          within(left, "regime_damping_now", damping_of(slides, "now")));
  const ExpressionId rate = writer_.constant("rate", "Hz", "1/h", tables_.head.rate, ConstantRole::sample_rate);
  numbers_.assign(found.now, writer_.multiply(now, rate), "b∞/h of the slips that give way now");
  ExpressionId wanted = now;
  if (!memories_.empty()) {
    for (std::size_t k = 0; k < slides.size(); ++k) slides[k] = memories_[k].write_output(slides[k], position);
    wanted = numbers_.named("slips_damping_wanted", writer_.damping(),
                            within(left, "regime_damping_wanted", damping_of(slides, "wanted")));
  }
  if (found.wanted != no_variable)
    numbers_.assign(found.wanted, wanted, "b for the slips that the command counts as sliding");
  if (!coil_lags()) return numbers_.assign(found.damping, wanted, "b for the slips that the command counts as sliding");
  const ExpressionId share = numbers_.constant(
      "coil_share", "1", "κ, share of the missing √b that the coil makes up in a sample", rule_.coil_share);
  root_now_ = numbers_.scalar("slips_brake_root_now", "1", "√b", Role::local);
  const ExpressionId way = writer_.subtract(writer_.square_root(wanted), writer_.read(root_));
  numbers_.assign(root_now_, writer_.add(writer_.read(root_), writer_.multiply(share, way)),
                  "√b ← √b + κ (√b_regime − √b)");
  numbers_.assign(found.damping, writer_.multiply(writer_.read(root_now_), writer_.read(root_now_)), "b");
}

void TunedSlips::write_resting_brake(VariableId damping, ExpressionId left) {
  const std::vector<ExpressionId> none(signs_.size(), nothing);
  numbers_.assign(damping, within(left, "regime_damping_at_rest", damping_of(none, "rest")), "b while all slips hold");
  if (root_ != nothing) numbers_.assign(root_, writer_.square_root(writer_.read(damping)), "");
}

ExpressionId TunedSlips::moved(const Graph& graph, int end) {
  if (end > graph.network.node_count) return nothing;
  return writer_.read(writer_.kept(end == graph.network.node_count ? change_ : graph.network.moved[place(end)]));
}

ExpressionId TunedSlips::elongation(std::size_t block) {
  if (elongations_[block] != nothing) return writer_.read(writer_.kept(elongations_[block]));
  for (Lone& lone : lone_)
    if (const ExpressionId stretched = lone.step.elongation(block); stretched != nothing) return stretched;
  for (const Graph& graph : graphs_) {
    const int tie = static_cast<int>(block) - graph.table->first_block;
    if (tie < 0 || tie >= graph.table->tie_count) continue;
    const TunableEnds& ends = tables_.ties[place(graph.table->first_tie + tie)];
    const ExpressionId from = moved(graph, ends.from), to = moved(graph, ends.to);
    return numbers_.named(joined(blocks_[block].name, "stretched"), writer_.length(),
                          to == nothing ? from : writer_.subtract(from, to));
  }
  return nothing;
}

void TunedSlips::keep() {
  for (SlideMemory& memory : memories_) memory.write_update();
  if (root_ != nothing) numbers_.assign(root_, writer_.read(writer_.kept(root_now_)), "");
}

// The damping, or what the brake has left if that is less.
ExpressionId TunedSlips::within(ExpressionId left, const std::string& name, ExpressionId damping) {
  if (constant_in(damping) == 0.0) return damping;
  return least_of(numbers_.named(name, writer_.damping(), damping), left);
}

ExpressionId TunedSlips::least_of(ExpressionId one, ExpressionId other) {
  const auto a = constant_in(one), b = constant_in(other);
  if (a && b) return *a < *b ? one : other;
  return writer_.where(writer_.subtract(other, one), one, other);
}

ExpressionId TunedSlips::largest_of(ExpressionId one, ExpressionId other) {
  const auto a = constant_in(one), b = constant_in(other);
  if (a && b) return *a > *b ? one : other;
  return writer_.where(writer_.subtract(one, other), one, other);
}

}  // namespace dashpot::compiler
