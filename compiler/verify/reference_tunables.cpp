#include "verify/reference_tunables.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "network/disjoint_sets.hpp"
#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

Reference value_in_100_digits(const Element& e) { return value_of(e.law); }

class Blocks {
 public:
  Blocks(const Network& network, const LawFacts& facts) : facts_(facts) {
    int next = 0;
    for (const Parameter& parameter : network.parameters) place_.push_back(parameter.tunable ? next++ : -1);
  }

  bool is_tunable(const Element& e) const { return e.parameter && place_[*e.parameter] >= 0; }

  // `index`: among the network's elements.
  ReferenceSum value(const Element& e, std::size_t index) const {
    if (!is_tunable(e)) return {value_in_100_digits(e), {}, {index}};
    ReferenceSum sum{0, {}, {index}};
    sum.factors.assign(std::size_t(place_[*e.parameter]) + 1, 0);
    sum.factors.back() = e.share;
    return sum;
  }

  // `network`: with every parameter at its largest; its i-th element is the network's elements[i].
  ReferenceBlock block(const Network& network, const ElementList& elements) const {
    ReferenceBlock block;
    for (std::size_t i = 0; i < elements.size(); ++i)
      if (network.elements[i].has_effect) block.elements.push_back(elements[i]);
    std::sort(block.elements.begin(), block.elements.end());
    block.largest_stiffness = companion(reference_form(network), facts_);
    Network fixed = network;
    for (const std::vector<std::size_t>& part : parts_between_ends(network)) {
      if (std::none_of(part.begin(), part.end(), [&](std::size_t i) { return is_tunable(network.elements[i]); }))
        continue;
      for (std::size_t i : part) fixed.elements[i].has_effect = false;
      add_part(network, part, elements, block);
    }
    add_fixed(reference_form(fixed), block);
    return block;
  }

  // Every way to cut through slips that act as one.
  std::vector<ReferenceSum> cuts(const Tree& tree, const Network& network) const {
    if (tree.kind == Tree::Kind::leaf) return {value(network.elements[tree.element], tree.element)};
    std::vector<ReferenceSum> all;
    if (tree.kind == Tree::Kind::parallel) all.emplace_back();
    for (const Tree& child : tree.children) {
      const std::vector<ReferenceSum> of_child = cuts(child, network);
      if (tree.kind == Tree::Kind::series) {
        all.insert(all.end(), of_child.begin(), of_child.end());
        continue;
      }
      std::vector<ReferenceSum> both;
      for (const ReferenceSum& cut : all)
        for (const ReferenceSum& more : of_child) both.push_back(added(cut, more));
      all = std::move(both);
    }
    return all;
  }

 private:
  static bool is_inner(NodeIndex node) { return node > tool; }

  void add_part(const Network& network, const std::vector<std::size_t>& part, const ElementList& elements,
                ReferenceBlock& block) const {
    const Element& first = network.elements[part.front()];
    if (!is_inner(first.a) && !is_inner(first.b)) {
      (is_spring(first.law) ? block.has_spring : block.has_damper) = true;
      ReferenceSum& sum = is_spring(first.law) ? block.stiffness : block.damping;
      sum = added(sum, value(first, elements[part.front()]));
      return;
    }
    is_relaxation(network, part) ? add_relaxation(network, part, elements, block)
                                 : add_mesh(network, part, elements, block);
  }

  // One inner node with all springs on one side of it and all dampers on the other.
  static bool is_relaxation(const Network& network, const std::vector<std::size_t>& part) {
    NodeIndex node = 0;
    std::optional<bool> springs_at_tool;
    for (std::size_t i : part) {
      const Element& e = network.elements[i];
      const NodeIndex inner = std::max(e.a, e.b), other = std::min(e.a, e.b);
      if (is_inner(other) || (node != 0 && inner != node)) return false;
      node = inner;
      const bool this_way = is_spring(e.law) == (other == tool);
      if (springs_at_tool && *springs_at_tool != this_way) return false;
      springs_at_tool = this_way;
    }
    return true;
  }

  void add_relaxation(const Network& network, const std::vector<std::size_t>& part, const ElementList& elements,
                      ReferenceBlock& block) const {
    ReferenceRelaxation relaxation{{}, {}, false, {}};
    for (std::size_t i : part) {
      ReferenceSum& sum = is_spring(network.elements[i].law) ? relaxation.stiffness : relaxation.damping;
      sum = added(sum, value(network.elements[i], elements[i]));
    }
    block.relaxations.push_back(std::move(relaxation));
  }

  void add_mesh(const Network& network, const std::vector<std::size_t>& part, const ElementList& elements,
                ReferenceBlock& block) const {
    std::map<std::tuple<NodeIndex, NodeIndex, bool>, ReferenceSum> edges;
    for (std::size_t i : part) {
      const Element& e = network.elements[i];
      ReferenceSum& sum = edges[{std::min(e.a, e.b), std::max(e.a, e.b), is_spring(e.law)}];
      sum = added(sum, value(e, elements[i]));
    }
    block.meshes.emplace_back();
    for (auto& [place, sum] : edges)
      block.meshes.back().push_back({std::get<0>(place) == tool, std::get<2>(place), std::move(sum)});
  }

  void add_fixed(const ReferenceForm& form, ReferenceBlock& block) const {
    block.stiffness.base += form.static_stiffness;
    block.damping.base += form.feedthrough_damping;
    block.has_spring = block.has_spring || form.static_stiffness > 0;
    block.has_damper = block.has_damper || form.feedthrough_damping > 0;
    for (const ReferenceMode& mode : form.modes)
      block.relaxations.push_back(
          {{mode.stiffness, {}}, {mode.stiffness / mode.relaxation_rate, {}}, true, mode_factors(mode, facts_)});
  }

  const LawFacts& facts_;
  std::vector<int> place_;
};

void add_blocks(const ReferencePart& part, const Network& network, const Blocks& blocks,
                std::vector<ReferenceBlock>& all, std::vector<std::vector<ReferenceSum>>& yields) {
  if (part.kind == ReferenceKind::block)
    all.push_back(blocks.block(laid_out(part.elements, network), elements_of(part.elements)));
  if (part.kind == ReferenceKind::slip) yields.push_back(blocks.cuts(part.elements, network));
  for (const ReferencePart& child : part.children) add_blocks(child, network, blocks, all, yields);
}

// Between two nodes, as tool and ground; inner nodes are its own.
Network between(NodeIndex from, NodeIndex to, const std::vector<std::size_t>& elements, const Network& network) {
  Network part;
  part.nodes = {"ground", "tool"};
  std::map<NodeIndex, NodeIndex> place = {{from, tool}, {to, ground}};
  for (std::size_t i : elements) {
    part.elements.push_back(network.elements[i]);
    for (NodeIndex* node : {&part.elements.back().a, &part.elements.back().b}) {
      if (place.count(*node) == 0) place[*node] = part.nodes.size(), part.nodes.push_back("");
      *node = place[*node];
    }
  }
  return part;
}

// The tool's side first.
std::pair<NodeIndex, NodeIndex> towards_ground(NodeIndex a, NodeIndex b) {
  if (a == tool || b == ground) return {a, b};
  if (b == tool || a == ground) return {b, a};
  return std::minmax(a, b);
}

// Springs and dampers that share nodes at which no slip ends: a block where they have two ends, else each by itself.
class GraphBuilder {
 public:
  GraphBuilder(const std::vector<std::size_t>& elements, const Network& network, const Blocks& blocks)
      : elements_(elements), network_(network), blocks_(blocks), ends_{tool, ground} {}

  void add_to(ReferenceTunables& result) {
    find_ends();
    sort_into_ports();
    ReferenceGraph graph;
    for (NodeIndex node : ends_)
      if (node > tool) graph.ends.push_back(node);
    for (auto& [nodes, port] : ports_) {
      std::sort(port.begin(), port.end());
      graph.ties.push_back(
          {nodes.first, nodes.second, blocks_.block(between(nodes.first, nodes.second, port, network_), port)});
    }
    for (const auto& [nodes, yield] : yields_) {
      graph.slips.push_back(nodes);
      result.yield_forces.push_back({yield});
    }
    result.graphs.push_back(std::move(graph));
  }

 private:
  bool is_end(NodeIndex node) const { return ends_.count(node) > 0; }
  const Element& element(std::size_t i) const { return network_.elements[i]; }
  bool is_slip(std::size_t i) const { return compiler::is_slip(element(i).law); }

  void find_ends() {
    for (std::size_t i : elements_) {
      if (!is_slip(i)) continue;
      ends_.insert({element(i).a, element(i).b});
      ReferenceSum& yield = yields_[std::minmax(element(i).a, element(i).b)];
      yield = added(yield, blocks_.value(element(i), i));
    }
  }

  // By the least of the inner nodes that they share.
  std::map<NodeIndex, std::vector<std::size_t>> groups() const {
    DisjointSets joined(network_.nodes.size());
    for (std::size_t i : elements_)
      if (!is_slip(i) && !is_end(element(i).a) && !is_end(element(i).b))
        joined.unite_by_least(element(i).a, element(i).b);
    std::map<NodeIndex, std::vector<std::size_t>> all;
    for (std::size_t i : elements_)
      if (!is_slip(i) && !(is_end(element(i).a) && is_end(element(i).b)))
        all[joined.find(is_end(element(i).a) ? element(i).b : element(i).a)].push_back(i);
    return all;
  }

  void sort_into_ports() {
    for (std::size_t i : elements_)
      if (!is_slip(i) && is_end(element(i).a) && is_end(element(i).b)) add_to_port(element(i).a, element(i).b, {i});
    std::set<NodeIndex> opened;
    for (const auto& [first, group] : groups()) {
      std::set<NodeIndex> touched, inner;
      for (std::size_t i : group)
        for (NodeIndex node : {element(i).a, element(i).b}) (is_end(node) ? touched : inner).insert(node);
      if (touched.size() == 2) {
        add_to_port(*touched.begin(), *touched.rbegin(), group);
        continue;
      }
      opened.insert(inner.begin(), inner.end());
      for (std::size_t i : group) add_to_port(element(i).a, element(i).b, {i});
    }
    ends_.insert(opened.begin(), opened.end());
  }

  void add_to_port(NodeIndex a, NodeIndex b, const std::vector<std::size_t>& more) {
    std::vector<std::size_t>& port = ports_[towards_ground(a, b)];
    port.insert(port.end(), more.begin(), more.end());
  }

  const std::vector<std::size_t>& elements_;
  const Network& network_;
  const Blocks& blocks_;
  std::set<NodeIndex> ends_;
  std::map<std::pair<NodeIndex, NodeIndex>, ReferenceSum> yields_;
  std::map<std::pair<NodeIndex, NodeIndex>, std::vector<std::size_t>> ports_;
};

Network at_largest(Network network) {
  for (Element& e : network.elements)
    if (const Parameter* tunable = network.tunable_of(e)) e.law = with_value(e.law, e.share * tunable->max);
  return network;
}

}  // namespace

ReferenceSum added(ReferenceSum first, const ReferenceSum& second, const Reference& weight) {
  first.base += weight * second.base;
  first.factors.resize(std::max(first.factors.size(), second.factors.size()), 0);
  for (std::size_t i = 0; i < second.factors.size(); ++i) first.factors[i] += weight * second.factors[i];
  first.elements.insert(first.elements.end(), second.elements.begin(), second.elements.end());
  return first;
}

ReferenceTunables reference_tunables(const Network& network, const LawFacts& facts) {
  ReferenceTunables result;
  for (const Parameter& parameter : network.parameters)
    if (parameter.tunable) result.parameters.push_back(&parameter);
  const Network largest = at_largest(network);
  const Blocks blocks(network, facts);
  result.tree = reference_tree(largest);
  // What stands in series has any order: in a tree that of the file.
  const bool is_tree = result.tree.has_slips() && series_parallel_tree(largest);
  const std::optional<Tree> linear = is_tree ? series_parallel_tree(result.tree.linear_network) : std::nullopt;
  ElementList all(network.elements.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  result.linear = linear ? blocks.block(laid_out(*linear, largest), elements_of(*linear))
                         : blocks.block(result.tree.linear_network, all);
  for (const ReferencePart& component : result.tree.components) {
    result.blocks.emplace_back();
    add_blocks(component, largest, blocks, result.blocks.back(), result.yield_forces);
  }
  for (const std::vector<std::size_t>& part : result.tree.networks) GraphBuilder(part, largest, blocks).add_to(result);
  return result;
}

Reference at_largest(const ReferenceSum& sum, const std::vector<const Parameter*>& parameters) {
  Reference value = sum.base;
  for (std::size_t i = 0; i < sum.factors.size(); ++i) value += sum.factors[i] * Reference(parameters[i]->max);
  return value;
}

}  // namespace dashpot::compiler
