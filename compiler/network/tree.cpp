#include "network/tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace dashpot::compiler {
namespace {

struct Edge {
  NodeIndex a;
  NodeIndex b;
  Tree tree;
};

using NodePair = std::pair<NodeIndex, NodeIndex>;

NodePair pair_of(NodeIndex a, NodeIndex b) { return std::minmax(a, b); }

std::vector<Tree> parts_of(Tree&& tree, Tree::Kind kind) {
  if (tree.kind == kind) return std::move(tree.children);
  std::vector<Tree> parts;
  parts.push_back(std::move(tree));
  return parts;
}

// Flattens as it joins; the shorter list moves, so that a long chain stays cheap.
Tree join(Tree::Kind kind, Tree&& x, Tree&& y) {
  std::vector<Tree> longer = parts_of(std::move(x), kind);
  std::vector<Tree> shorter = parts_of(std::move(y), kind);
  if (longer.size() < shorter.size()) std::swap(longer, shorter);
  std::move(shorter.begin(), shorter.end(), std::back_inserter(longer));
  return {kind, 0, std::move(longer)};
}

// Two edges between the same nodes are one in parallel; two edges that meet alone at an inner node are one in series.
class Reduction {
 public:
  explicit Reduction(const Network& network) : edges_at_(network.nodes.size()) {
    for (std::size_t i = 0; i < network.elements.size(); ++i)
      if (const Element& element = network.elements[i]; element.has_effect)
        add(element.a, element.b, {Tree::Kind::leaf, i, {}});
  }

  std::optional<Tree> reduce() {
    for (NodeIndex node = 0; node < edges_at_.size(); ++node) reduce_at(node);
    if (edges_.empty()) return Tree{Tree::Kind::parallel, 0, {}};
    if (edges_.size() > 1) return std::nullopt;
    return std::move(edges_.begin()->second);
  }

 private:
  void add(NodeIndex a, NodeIndex b, Tree tree) {
    const auto known = edges_.find(pair_of(a, b));
    if (known != edges_.end()) {
      known->second = join(Tree::Kind::parallel, std::move(known->second), std::move(tree));
      return;
    }
    edges_.emplace(pair_of(a, b), std::move(tree));
    edges_at_[a].insert(b);
    edges_at_[b].insert(a);
  }

  Tree take(NodeIndex a, NodeIndex b) {
    edges_at_[a].erase(b);
    edges_at_[b].erase(a);
    return std::move(edges_.extract(pair_of(a, b)).mapped());
  }

  // Taking a node away can leave a neighbour with two edges, which is looked at again.
  void reduce_at(NodeIndex start) {
    std::vector<NodeIndex> waiting{start};
    while (!waiting.empty()) {
      const NodeIndex node = waiting.back();
      waiting.pop_back();
      if (node == tool || node == ground || edges_at_[node].size() != 2) continue;
      const NodeIndex a = *edges_at_[node].begin();
      const NodeIndex b = *edges_at_[node].rbegin();
      Tree first = take(node, a);
      Tree second = take(node, b);
      add(a, b, join(Tree::Kind::series, std::move(first), std::move(second)));
      waiting.push_back(a);
      waiting.push_back(b);
    }
  }

  std::map<NodePair, Tree> edges_;
  std::vector<std::set<NodeIndex>> edges_at_;  // neighbours
};

// Returns the first element below.
std::size_t sort_in_file_order(Tree& tree) {
  if (tree.kind == Tree::Kind::leaf) return tree.element;
  std::vector<std::pair<std::size_t, Tree>> children;
  for (Tree& child : tree.children) {
    const std::size_t first = sort_in_file_order(child);
    children.emplace_back(first, std::move(child));
  }
  std::sort(children.begin(), children.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  for (std::size_t i = 0; i < children.size(); ++i) tree.children[i] = std::move(children[i].second);
  return children.front().first;
}

void append(std::string& out, const Tree& tree, const Network& network) {
  if (tree.kind == Tree::Kind::leaf) {
    out += network.elements[tree.element].name;
    return;
  }
  out += tree.kind == Tree::Kind::series ? "series(" : "parallel(";
  for (std::size_t i = 0; i < tree.children.size(); ++i) {
    if (i > 0) out += ", ";
    append(out, tree.children[i], network);
  }
  out += ")";
}

}  // namespace

std::optional<Tree> series_parallel_tree(const Network& network) {
  std::optional<Tree> tree = Reduction(network).reduce();
  if (tree && !(tree->kind == Tree::Kind::parallel && tree->children.empty())) sort_in_file_order(*tree);
  return tree;
}

std::string to_text(const Tree& tree, const Network& network) {
  std::string text;
  append(text, tree, network);
  return text;
}

}  // namespace dashpot::compiler
