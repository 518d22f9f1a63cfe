#include "network/tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace dashpot::compiler {
namespace {

// Deeper trees are not taken for trees, because whatever walks over one recurses.
constexpr std::size_t deepest_tree = 1000;

struct Branch {
  Tree tree;
  std::size_t depth;  // of nested groups
};

using NodePair = std::pair<NodeIndex, NodeIndex>;

NodePair pair_of(NodeIndex a, NodeIndex b) { return std::minmax(a, b); }

std::vector<Tree> parts_of(Tree&& tree, Tree::Kind kind) {
  if (tree.kind == kind) return std::move(tree.children);
  std::vector<Tree> parts;
  parts.push_back(std::move(tree));
  return parts;
}

std::size_t depth_inside(const Branch& branch, Tree::Kind kind) {
  return branch.tree.kind == kind ? branch.depth : branch.depth + 1;
}

// Flattens as it joins; the shorter list moves, so that a long chain stays cheap.
Branch join(Tree::Kind kind, Branch&& x, Branch&& y) {
  const std::size_t depth = std::max(depth_inside(x, kind), depth_inside(y, kind));
  std::vector<Tree> longer = parts_of(std::move(x.tree), kind);
  std::vector<Tree> shorter = parts_of(std::move(y.tree), kind);
  if (longer.size() < shorter.size()) std::swap(longer, shorter);
  std::move(shorter.begin(), shorter.end(), std::back_inserter(longer));
  return {{kind, 0, std::move(longer)}, depth};
}

// Two edges between the same nodes are one in parallel; two edges that meet alone at an inner node are one in series.
class Reduction {
 public:
  explicit Reduction(const Network& network) : edges_at_(network.nodes.size()) {
    for (std::size_t i = 0; i < network.elements.size(); ++i)
      if (const Element& element = network.elements[i]; element.has_effect)
        add(element.a, element.b, {{Tree::Kind::leaf, i, {}}, 0});
  }

  std::optional<Tree> reduce() {
    for (NodeIndex node = 0; node < edges_at_.size(); ++node) reduce_at(node);
    if (edges_.empty()) return Tree{Tree::Kind::parallel, 0, {}};
    if (edges_.size() > 1 || too_deep_) return std::nullopt;
    return std::move(edges_.begin()->second.tree);
  }

 private:
  void add(NodeIndex a, NodeIndex b, Branch branch) {
    too_deep_ = too_deep_ || branch.depth > deepest_tree;
    const auto known = edges_.find(pair_of(a, b));
    if (known != edges_.end()) {
      known->second = join(Tree::Kind::parallel, std::move(known->second), std::move(branch));
      return;
    }
    edges_.emplace(pair_of(a, b), std::move(branch));
    edges_at_[a].insert(b);
    edges_at_[b].insert(a);
  }

  Branch take(NodeIndex a, NodeIndex b) {
    edges_at_[a].erase(b);
    edges_at_[b].erase(a);
    return std::move(edges_.extract(pair_of(a, b)).mapped());
  }

  // Taking a node away can leave a neighbour with two edges, which is looked at again.
  void reduce_at(NodeIndex start) {
    std::vector<NodeIndex> waiting{start};
    while (!waiting.empty() && !too_deep_) {
      const NodeIndex node = waiting.back();
      waiting.pop_back();
      if (node == tool || node == ground || edges_at_[node].size() != 2) continue;
      const NodeIndex a = *edges_at_[node].begin();
      const NodeIndex b = *edges_at_[node].rbegin();
      Branch first = take(node, a);
      Branch second = take(node, b);
      add(a, b, join(Tree::Kind::series, std::move(first), std::move(second)));
      waiting.push_back(a);
      waiting.push_back(b);
    }
  }

  std::map<NodePair, Branch> edges_;
  std::vector<std::set<NodeIndex>> edges_at_;  // neighbours
  bool too_deep_ = false;
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
