// What is left of a network when some of its slips hold and the others give way.
#include "decompose/regimes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/shrink.hpp"
#include "support/written_network.hpp"

namespace dashpot::compiler {
namespace {

RegimeList regimes_of_whole(const Network& network) {
  std::vector<std::size_t> all;
  std::vector<SlipElements> slips;
  for (std::size_t i = 0; i < network.elements.size(); ++i) {
    all.push_back(i);
    if (std::holds_alternative<Slip>(network.elements[i].law)) slips.push_back({i});
  }
  return regimes_of(network, all, slips, 0);
}

RegimeList regimes_of_whole(const std::string& structure) {
  return regimes_of_whole(testing::written_network(structure));
}

void expect_regime(const Regime& regime, double damping, double feedthrough) {
  EXPECT_NEAR(to_double(regime.damping), damping, 1e-15 * damping);
  EXPECT_NEAR(to_double(regime.feedthrough()), feedthrough, 1e-15 * feedthrough);
}

// Fails if Fig. 10 gives the brake anything but B1 stuck and B1 + B2 sliding, or takes B2, which is behind K, for a
// port damper.
TEST(Regimes, Figure10) {
  const RegimeList list = regimes_of_whole(R"({"parallel": [{"damper": 2}, {"series": [{"spring": 300},
      {"parallel": [{"slip": 1}, {"damper": 3}]}]}]})");
  ASSERT_EQ(list.regimes.size(), 2u);
  expect_regime(list.regimes[0], 2, 2);
  expect_regime(list.regimes[1], 5, 2);
}

// Fails if a Kelvin element behind a slip brakes what slides.
TEST(Regimes, KelvinBeforeASlip) {
  const RegimeList list =
      regimes_of_whole(R"({"series": [{"parallel": [{"spring": 500}, {"damper": 5}]}, {"slip": 0.4}]})");
  expect_regime(list.regimes[0], 5, 5);
  expect_regime(list.regimes[1], 0, 0);
}

// Fails if dampers in series do not add their inverses, or the observer of the sliding network is not its own.
TEST(Regimes, KelvinsAboutASlip) {
  const RegimeList list = regimes_of_whole(R"({"series": [{"parallel": [{"spring": 1000}, {"damper": 10}]},
      {"parallel": [{"slip": 2}, {"spring": 1}, {"damper": 0.1}]}]})");
  expect_regime(list.regimes[0], 10, 10);
  expect_regime(list.regimes[1], 0.1, 1 / (1 / 10.0 + 1 / 0.1));
}

// Fails if slips outside of trees are not joined and removed as they are in trees.
TEST(Regimes, Bridge) {
  const RegimeList list = regimes_of_whole(R"([
      {"damper": 2, "nodes": ["tool", "a"]}, {"damper": 4, "nodes": ["tool", "b"]}, {"slip": 1, "nodes": ["a", "b"]},
      {"damper": 3, "nodes": ["a", "ground"]}, {"damper": 6, "nodes": ["b", "ground"]}])");
  const double joined = 1 / (1 / 6.0 + 1 / 9.0), apart = 1 / (1 / 2.0 + 1 / 3.0) + 1 / (1 / 4.0 + 1 / 6.0);
  expect_regime(list.regimes[0], joined, joined);
  expect_regime(list.regimes[1], apart, apart);
}

// Fails if many slips are enumerated, or their number is not said.
TEST(Regimes, OfManySlipsAreCounted) {
  std::string text = R"({"spring": 100})";
  for (int i = 0; i < 12; ++i) text = R"({"series": [{"spring": 100}, {"parallel": [{"slip": 1}, )" + text + "]}]}";
  const RegimeList list = regimes_of_whole(text);
  EXPECT_TRUE(list.regimes.empty());
  EXPECT_EQ(list.count, 4096);
}

// Theory, section 5: rigid, of constant force, or with a feedthrough.
struct Hold {
  enum class Kind { rigid, constant, damped } kind;
  double feedthrough = 0;
};

Hold in_parallel(const std::vector<Hold>& children) {
  Hold sum{Hold::Kind::constant};
  for (const Hold& child : children) {
    if (child.kind == Hold::Kind::rigid) return child;
    if (child.kind == Hold::Kind::damped) sum.kind = Hold::Kind::damped;
    sum.feedthrough += child.feedthrough;
  }
  return sum;
}

Hold in_series(const std::vector<Hold>& children) {
  double mobility = 0;
  bool all_rigid = true, soft = false;
  for (const Hold& child : children) {
    if (child.kind == Hold::Kind::constant) return {Hold::Kind::constant};
    if (child.kind == Hold::Kind::rigid) continue;
    all_rigid = false;
    soft = soft || child.feedthrough == 0;
    mobility += 1 / child.feedthrough;
  }
  if (all_rigid) return {Hold::Kind::rigid};
  return {Hold::Kind::damped, soft ? 0 : 1 / mobility};
}

Hold hold_of(const Tree& tree, const Network& network, const std::vector<bool>& slides) {
  if (tree.kind == Tree::Kind::leaf) {
    const Law& law = network.elements[tree.element].law;
    if (const Damper* damper = std::get_if<Damper>(&law)) return {Hold::Kind::damped, damper->damping};
    if (std::holds_alternative<Spring>(law)) return {Hold::Kind::damped};
    return {slides[tree.element] ? Hold::Kind::constant : Hold::Kind::rigid};
  }
  std::vector<Hold> children;
  for (const Tree& child : tree.children) children.push_back(hold_of(child, network, slides));
  return tree.kind == Tree::Kind::series ? in_series(children) : in_parallel(children);
}

std::string departure_from_the_rules(const Network& network) {
  const std::optional<Tree> tree = series_parallel_tree(network);
  const RegimeList list = regimes_of_whole(network);
  if (!tree) return "";
  for (const Regime& regime : list.regimes) {
    std::vector<bool> slides(network.elements.size(), false);
    for (std::size_t i = 0; i < list.slips.size(); ++i) slides[list.slips[i].front()] = regime.slides[i];
    const double expected = hold_of(*tree, network, slides).feedthrough, actual = to_double(regime.feedthrough());
    if (!(std::abs(actual - expected) <= 1e-13 * expected))
      return fmt::format("feedthrough {} for {}", actual, expected);
    if (regime.damping < regime.feedthrough()) return "the observer's damping is less than the feedthrough";
  }
  return "";
}

// Fails if a regime's feedthrough is not that of the rules for rigid and constant parts.
TEST(Regimes, FollowTheRulesOfRigidAndConstantParts) {
  testing::NetworkRecipe recipe;
  recipe.most_nodes = 9;
  recipe.most_slips = 6;
  EXPECT_EQ(testing::first_failure(1, testing::repetitions(90, 10000), recipe, departure_from_the_rules), "");
}

}  // namespace
}  // namespace dashpot::compiler
