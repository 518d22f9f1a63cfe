#include "network/effect.hpp"

#include <algorithm>
#include <utility>

#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

struct HalfEdge {
  std::size_t edge;
  NodeIndex to;
};

using Adjacency = std::vector<std::vector<HalfEdge>>;

// The edge from tool to ground comes last.
Adjacency adjacency_with_closing_edge(const Network& network, const std::vector<bool>& passable) {
  Adjacency adjacency(network.nodes.size());
  const auto connect = [&](std::size_t edge, NodeIndex a, NodeIndex b) {
    adjacency[a].push_back({edge, b});
    adjacency[b].push_back({edge, a});
  };
  for (std::size_t i = 0; i < network.elements.size(); ++i)
    if (passable[i]) connect(i, network.elements[i].a, network.elements[i].b);
  connect(network.elements.size(), tool, ground);
  return adjacency;
}

// Depth-first search from the tool, without recursion since networks may be long chains.
class BlockOfClosingEdge {
 public:
  explicit BlockOfClosingEdge(const Adjacency& adjacency, std::size_t closing_edge)
      : adjacency_(adjacency), closing_edge_(closing_edge), depth_(adjacency.size(), 0), low_(adjacency.size(), 0) {}

  // One entry an edge, the closing one included.
  std::vector<bool> find() {
    in_block_.assign(closing_edge_ + 1, false);
    enter(tool, closing_edge_ + 1);
    while (!path_.empty())
      if (path_.back().next < adjacency_[path_.back().node].size())
        follow(adjacency_[path_.back().node][path_.back().next++]);
      else leave();
    return in_block_;
  }

 private:
  struct Visit {
    NodeIndex node;
    std::size_t edge;  // by which the node was entered
    std::size_t next;  // half edge to follow
  };

  void enter(NodeIndex node, std::size_t edge) {
    depth_[node] = low_[node] = path_.size() + 1;
    path_.push_back({node, edge, 0});
  }

  void follow(const HalfEdge& half) {
    const Visit& here = path_.back();
    if (half.edge == here.edge) return;
    if (depth_[half.to] == 0) {
      edges_.push_back(half.edge);
      enter(half.to, half.edge);
    } else if (depth_[half.to] < depth_[here.node]) {
      edges_.push_back(half.edge);
      low_[here.node] = std::min(low_[here.node], depth_[half.to]);
    }
  }

  void leave() {
    const Visit left = path_.back();
    path_.pop_back();
    if (path_.empty()) return;
    const NodeIndex parent = path_.back().node;
    low_[parent] = std::min(low_[parent], low_[left.node]);
    if (low_[left.node] >= depth_[parent]) take_block(left.edge);
  }

  // The block's edges lie on top of the stack, down to the one that entered it.
  void take_block(std::size_t entering_edge) {
    const auto begin = std::find(edges_.rbegin(), edges_.rend(), entering_edge).base() - 1;
    const bool holds_closing_edge = std::find(begin, edges_.end(), closing_edge_) != edges_.end();
    if (holds_closing_edge)
      for (auto edge = begin; edge != edges_.end(); ++edge) in_block_[*edge] = true;
    edges_.erase(begin, edges_.end());
  }

  const Adjacency& adjacency_;
  std::size_t closing_edge_;
  std::vector<std::size_t> depth_;  // 0: not yet seen
  std::vector<std::size_t> low_;    // least depth within reach of one edge upwards
  std::vector<Visit> path_;
  std::vector<std::size_t> edges_;
  std::vector<bool> in_block_;
};

}  // namespace

std::vector<bool> on_path_between_ends(const Network& network, const std::vector<bool>& passable) {
  const std::size_t closing_edge = network.elements.size();
  const Adjacency adjacency = adjacency_with_closing_edge(network, passable);
  std::vector<bool> on_path = BlockOfClosingEdge(adjacency, closing_edge).find();
  on_path.pop_back();
  return on_path;
}

Network with_effect_of(const std::vector<std::size_t>& elements, Network network) {
  for (Element& element : network.elements) element.has_effect = false;
  for (std::size_t element : elements) network.elements[element].has_effect = true;
  return network;
}

Network along(const std::vector<bool>& passable, Network network) {
  const std::vector<bool> on_path = on_path_between_ends(network, passable);
  for (std::size_t i = 0; i < on_path.size(); ++i) network.elements[i].has_effect = on_path[i];
  return network;
}

std::vector<bool> may_carry_force(const Network& network) {
  std::vector<bool> may_carry;
  for (const Element& element : network.elements) {
    const Parameter* tunable = network.tunable_of(element);
    const bool may_grow = tunable != nullptr && tunable->max > 0 && element.share > 0;
    may_carry.push_back(value_of(element.law) > 0 || may_grow);
  }
  return may_carry;
}

Network at_default(const Network& network) {
  std::vector<bool> passable;
  for (const Element& element : network.elements) passable.push_back(element.has_effect && value_of(element.law) > 0);
  return along(passable, network);
}

}  // namespace dashpot::compiler
