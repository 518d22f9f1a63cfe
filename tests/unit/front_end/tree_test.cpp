#include "network/tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "front_end_run.hpp"
#include "support/random.hpp"

namespace dashpot::compiler {
namespace {

Network network_of(std::size_t nodes) {
  Network network;
  network.nodes = {"ground", "tool"};
  while (network.nodes.size() < nodes) network.nodes.push_back("n" + std::to_string(network.nodes.size()));
  return network;
}

void add_spring(Network& network, NodeIndex a, NodeIndex b) {
  network.elements.push_back({"k" + std::to_string(network.elements.size()), Spring{1}, a, b, {}, {}});
}

NodeIndex new_node(Network& network) {
  network.nodes.push_back("n" + std::to_string(network.nodes.size()));
  return network.nodes.size() - 1;
}

// Grows a random tree between two nodes of the network, leaves in the order in which they are added.
Tree grow(Network& network, NodeIndex a, NodeIndex b, int depth, Tree::Kind above, testing::Random& random) {
  if (depth == 0 || random.chance(0.3)) {
    add_spring(network, a, b);
    if (random.chance(0.5)) std::swap(network.elements.back().a, network.elements.back().b);
    return {Tree::Kind::leaf, network.elements.size() - 1, {}};
  }
  const Tree::Kind kind = above == Tree::Kind::series ? Tree::Kind::parallel : Tree::Kind::series;
  Tree tree{kind, 0, {}};
  NodeIndex from = a;
  for (std::size_t left = random.between(2, 4); left > 0; --left) {
    const NodeIndex to = kind == Tree::Kind::parallel || left == 1 ? b : new_node(network);
    tree.children.push_back(grow(network, from, to, depth - 1, kind, random));
    if (kind == Tree::Kind::series) from = to;
  }
  return tree;
}

std::size_t first_element(const Tree& tree) {
  std::size_t first = tree.element;
  for (std::size_t i = 0; i < tree.children.size(); ++i)
    first = i == 0 ? first_element(tree.children[0]) : std::min(first, first_element(tree.children[i]));
  return first;
}

void renumber(Tree& tree, const std::vector<std::size_t>& new_place) {
  if (tree.kind == Tree::Kind::leaf) tree.element = new_place[tree.element];
  for (Tree& child : tree.children) renumber(child, new_place);
  std::sort(tree.children.begin(), tree.children.end(),
            [](const Tree& x, const Tree& y) { return first_element(x) < first_element(y); });
}

// The elements of the file in another order.
void shuffle(Network& network, Tree& tree, testing::Random& random) {
  std::vector<std::size_t> new_place(network.elements.size());
  std::iota(new_place.begin(), new_place.end(), std::size_t{0});
  for (std::size_t i = new_place.size(); i > 1; --i) std::swap(new_place[i - 1], new_place[random.index(i)]);
  std::vector<Element> elements(network.elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) elements[new_place[i]] = network.elements[i];
  network.elements = std::move(elements);
  renumber(tree, new_place);
}

// If this fails, a tree is not recognised, is not flat, or has its branches in another order than the file.
TEST(Tree, IsFoundAgainHoweverTheNetworkIsListed) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    testing::Random random(seed);
    Network network = network_of(2);
    Tree grown = grow(network, tool, ground, 4, random.chance(0.5) ? Tree::Kind::series : Tree::Kind::parallel, random);
    shuffle(network, grown, random);
    const auto found = series_parallel_tree(network);
    ASSERT_TRUE(found) << "seed " << seed;
    EXPECT_EQ(to_text(*found, network), to_text(grown, network)) << "seed " << seed;
  }
}

void add_bridge(Network& network, NodeIndex a, NodeIndex b) {
  const NodeIndex left = new_node(network);
  const NodeIndex right = new_node(network);
  for (const auto& [from, to] : {std::pair(a, left), {a, right}, {left, right}, {left, b}, {right, b}})
    add_spring(network, from, to);
}

// If this fails, a bridge is taken for a tree, and everything computed on it is wrong.
TEST(Tree, IsNotFoundWhereABridgeHides) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    testing::Random random(seed);
    Network network = network_of(2);
    grow(network, tool, ground, 3, Tree::Kind::series, random);
    const Element host = network.elements[random.index(network.elements.size())];
    add_bridge(network, host.a, host.b);
    EXPECT_FALSE(series_parallel_tree(network)) << "seed " << seed;
  }
}

// If this fails, elements that carry no force hide a tree or appear in it.
TEST(Tree, LeavesOutElementsWithoutEffect) {
  Network network = network_of(2);
  add_bridge(network, tool, ground);
  network.elements[2].has_effect = false;
  EXPECT_EQ(to_text(*series_parallel_tree(network), network), "parallel(series(k0, k3), series(k1, k4))");
}

// If this fails, a network in which nothing has an effect is not a force of zero.
TEST(Tree, OfNothingIsAnEmptyParallel) {
  const Network network = network_of(2);
  EXPECT_EQ(to_text(*series_parallel_tree(network), network), "parallel()");
}

// If this fails, a long chain takes quadratic time or exhausts the stack.
TEST(Tree, MayBeVeryLong) {
  constexpr std::size_t length = 20000;
  Network chain = network_of(length + 1);
  for (std::size_t i = 1; i <= length; ++i) add_spring(chain, i, i == length ? ground : i + 1);
  EXPECT_EQ(series_parallel_tree(chain)->children.size(), length);
}

Network ladder(std::size_t rungs) {
  Network network = network_of(rungs + 2);
  for (std::size_t i = 1; i <= rungs; ++i) {
    add_spring(network, i, i + 1);
    add_spring(network, i + 1, ground);
  }
  return network;
}

std::size_t depth_of(const Tree& tree) {
  std::size_t depth = 0;
  for (const Tree& child : tree.children) depth = std::max(depth, 1 + depth_of(child));
  return depth;
}

// If this fails, a tree can be nested so deep that whatever walks over it exhausts the stack.
TEST(Tree, IsNestedUpToAThousandDeep) {
  EXPECT_EQ(to_text(*series_parallel_tree(ladder(2)), ladder(2)), "series(k0, parallel(k1, series(k2, k3)))");
  EXPECT_EQ(depth_of(*series_parallel_tree(ladder(500))), 999u);
  EXPECT_FALSE(series_parallel_tree(ladder(501)));
  EXPECT_FALSE(series_parallel_tree(ladder(10000)));
}

// If this fails, the paper's networks are not read as what they are drawn as.
TEST(Tree, OfAFileIsTheOneThatWasWritten) {
  const NetworkRun run(R"({"dashpot": 1, "name": "n", "network": {"parallel": [
      {"series": [{"damper": 5, "name": "B1"}, {"parallel": [{"spring": 1, "name": "K1"}]}, {"series": [{"spring": 2, "name": "K2"}]}]},
      {"parallel": [{"spring": 3, "name": "K3"}, {"spring": 4, "name": "K4"}]}]}})");
  ASSERT_TRUE(run.network) << run.said();
  EXPECT_EQ(to_text(*series_parallel_tree(*run.network), *run.network), "parallel(series(B1, K1, K2), K3, K4)");
}

}  // namespace
}  // namespace dashpot::compiler
