#include "network/effect.hpp"

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace dashpot::compiler {
namespace {

// Every path from tool to ground that meets no node twice, by trying them all.
class PathSearch {
 public:
  PathSearch(const Network& network, const std::vector<bool>& passable)
      : network_(network), passable_(passable), visited_(network.nodes.size()), on_path_(network.elements.size()) {}

  std::vector<bool> elements_on_paths() {
    walk_from(tool);
    return on_path_;
  }

 private:
  void walk_from(NodeIndex node) {
    if (node == ground) {
      for (const std::size_t element : path_) on_path_[element] = true;
      return;
    }
    visited_[node] = true;
    for (std::size_t i = 0; i < network_.elements.size(); ++i) step(i, node);
    visited_[node] = false;
  }

  void step(std::size_t i, NodeIndex node) {
    const Element& element = network_.elements[i];
    if (!passable_[i] || (element.a != node && element.b != node)) return;
    const NodeIndex next = element.a == node ? element.b : element.a;
    if (visited_[next]) return;
    path_.push_back(i);
    walk_from(next);
    path_.pop_back();
  }

  const Network& network_;
  const std::vector<bool>& passable_;
  std::vector<bool> visited_;
  std::vector<bool> on_path_;
  std::vector<std::size_t> path_;
};

Network random_graph(testing::Random& random) {
  Network network;
  network.nodes.resize(random.between(2, 7));
  for (std::size_t count = random.between(0, 11); count > 0; --count) {
    const NodeIndex a = random.index(network.nodes.size());
    const NodeIndex b = random.index(network.nodes.size());
    if (a != b) network.elements.push_back({"", Spring{1}, a, b, {}, {}});
  }
  return network;
}

// If this fails, elements that carry force are dropped, or dead ones stay and make matrices singular.
TEST(Effect, IsOnSomePathFromToolToGround) {
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    testing::Random random(seed);
    const Network network = random_graph(random);
    std::vector<bool> passable;
    for (std::size_t i = 0; i < network.elements.size(); ++i) passable.push_back(random.chance(0.85));
    EXPECT_EQ(on_path_between_ends(network, passable), PathSearch(network, passable).elements_on_paths())
        << "seed " << seed;
  }
}

// If this fails, a chain of 20,000 elements overflows the stack or takes quadratic time.
TEST(Effect, OfALongChainIsFound) {
  constexpr std::size_t length = 20000;
  Network network;
  network.nodes.resize(length + 1);
  for (NodeIndex i = tool; i <= length; ++i)
    network.elements.push_back({"", Spring{1}, i, i == length ? ground : i + 1, {}, {}});
  std::vector<bool> passable(length, true);
  EXPECT_EQ(on_path_between_ends(network, passable), passable);
  passable[length / 2] = false;
  EXPECT_EQ(on_path_between_ends(network, passable), std::vector<bool>(length, false));
}

// If this fails, a tunable element that starts at zero never wakes up, or one that stays zero counts as present.
TEST(Effect, OfATunableElementCountsIfItCanBecomeNonZero) {
  Network network;
  network.nodes = {"ground", "tool"};
  network.parameters = {{"constant", 0, false, 0, 5, {}}, {"tunable", 0, true, 0, 5, {}}, {"stuck", 0, true, 0, 0, {}}};
  for (std::size_t i = 0; i < 3; ++i) network.elements.push_back({"", Damper{0}, tool, ground, {}, i});
  network.elements.push_back({"", Slip{2}, tool, ground, {}, {}});
  EXPECT_EQ(may_carry_force(network), (std::vector<bool>{false, true, false, true}));
}

}  // namespace
}  // namespace dashpot::compiler
