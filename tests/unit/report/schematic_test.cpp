#include "report/schematic.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <regex>

#include "network/tree.hpp"
#include "support/random_network.hpp"
#include "report/rail_layout.hpp"
#include "report/tree_layout.hpp"
#include "support/written_network.hpp"

namespace dashpot::compiler {
namespace {

using testing::written_network;

struct Label {
  std::string name;
  double x, y;
};

std::vector<Label> labels(const std::string& svg) {
  static const std::regex pattern("class=\"name\" x=\"([-0-9.]+)\" y=\"([-0-9.]+)\">([^<]*)<");
  std::vector<Label> all;
  for (std::sregex_iterator match(svg.begin(), svg.end(), pattern), end; match != end; ++match)
    all.push_back({(*match)[3], std::stod((*match)[1]), std::stod((*match)[2])});
  return all;
}

const Label& label(const std::vector<Label>& all, const std::string& name) {
  for (const Label& one : all)
    if (one.name == name) return one;
  throw std::out_of_range(name);
}

// No two elements closer than a symbol and its label need, and all within the drawing.
void expect_tidy(const std::vector<Label>& all, const Inside& inside) {
  for (const Label& a : all) {
    EXPECT_GT(a.x, 0) << a.name;
    EXPECT_LT(a.x, inside.length) << a.name;
    EXPECT_GT(a.y, 0) << a.name;
    EXPECT_LT(a.y, inside.height) << a.name;
    for (const Label& b : all) {
      const bool apart = std::abs(a.x - b.x) >= symbol_length || std::abs(a.y - b.y) >= label_rise + symbol_drop;
      EXPECT_TRUE(apart || &a == &b) << a.name << ", " << b.name;
    }
  }
}

// All corners of paths, middles of circles, and places of words, where they come to lie on the paper.
std::vector<Place> ink(const std::string& svg) {
  static const std::regex tags(
      "translate\\(([-0-9.]+) ([-0-9.]+)\\)|x=\"([-0-9.]+)\" c?y=\"([-0-9.]+)\"| d=\"([^\"]*)\"");
  static const std::regex moves("([MLHVmlhv])([-0-9.]+)(?: ([-0-9.]+))?");
  std::vector<Place> all;
  Place moved{0, 0};
  for (std::sregex_iterator tag(svg.begin(), svg.end(), tags), end; tag != end; ++tag) {
    if ((*tag)[1].matched) moved = {std::stod((*tag)[1]), std::stod((*tag)[2])};
    if ((*tag)[3].matched) all.push_back({moved.x + std::stod((*tag)[3]), moved.y + std::stod((*tag)[4])});
    const std::string path = (*tag)[5];
    Place pen{0, 0};
    for (std::sregex_iterator move(path.begin(), path.end(), moves); move != end; ++move) {
      const char kind = (*move)[1].str()[0];
      const double first = std::stod((*move)[2]), from_x = std::islower(kind) ? pen.x : 0,
                   from_y = std::islower(kind) ? pen.y : 0;
      if (kind == 'H' || kind == 'h') pen.x = from_x + first;
      else if (kind == 'V' || kind == 'v') pen.y = from_y + first;
      else pen = {from_x + first, from_y + std::stod((*move)[3])};
      all.push_back({moved.x + pen.x, moved.y + pen.y});
    }
  }
  return all;
}

void expect_on_paper(const Network& network) {
  const std::string svg = schematic(network);
  static const std::regex pattern("viewBox=\"0 0 ([0-9.]+) ([0-9.]+)\"");
  std::smatch paper;
  ASSERT_TRUE(std::regex_search(svg, paper, pattern));
  for (const Place& place : ink(svg)) {
    EXPECT_TRUE(place.x > 0 && place.x < std::stod(paper[1])) << place.x;
    EXPECT_TRUE(place.y > 0 && place.y < std::stod(paper[2])) << place.y;
  }
}

std::size_t elements_with_effect(const Network& network) {
  std::size_t count = 0;
  for (const Element& element : network.elements) count += element.has_effect;
  return count;
}

// If this fails, series does not run along the force, or parallel not across it.
TEST(TreeLayout, PutsSeriesInARowAndParallelInAStack) {
  const Network network = written_network(
      R"({"parallel": [{"series": [{"damper": 5, "name": "B"}, {"spring": 12, "name": "K"}]}, {"damper": 1, "name": "Y"}, {"spring": 5, "name": "L"}]})");
  const std::vector<Label> all = labels(schematic(network));
  EXPECT_EQ(label(all, "B").y, label(all, "K").y);
  EXPECT_LT(label(all, "B").x, label(all, "K").x);
  EXPECT_LT(label(all, "K").y, label(all, "Y").y);
  EXPECT_LT(label(all, "Y").y, label(all, "L").y);
  EXPECT_EQ(label(all, "Y").x, label(all, "L").x);
}

// If this fails, an element of a tree is missing, drawn twice, or drawn over another.
TEST(TreeLayout, DrawsEveryElementOnce) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Network network = testing::random_network(seed, {.most_nodes = 12, .most_slips = 3});
    const std::optional<Tree> tree = series_parallel_tree(network);
    ASSERT_TRUE(tree);
    const Inside inside = tree_layout(*tree, network);
    const std::vector<Label> all = labels(inside.svg);
    EXPECT_EQ(all.size(), elements_with_effect(network));
    expect_tidy(all, inside);
    expect_on_paper(network);
  }
}

// If this fails, an element of a network that is no tree is missing, drawn twice, or drawn over another.
TEST(RailLayout, DrawsEveryElementOnce) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Network network = testing::random_network(seed, {.topology = testing::Topology::graph, .most_nodes = 9});
    const Inside inside = rail_layout(network);
    const std::vector<Label> all = labels(inside.svg);
    EXPECT_EQ(all.size(), elements_with_effect(network));
    expect_tidy(all, inside);
    expect_on_paper(network);
  }
}

// If this fails, a tree's drawing has empty paper above or below it.
TEST(TreeLayout, TakesNoMoreRoomThanItNeeds) {
  constexpr double lightest_drop = 9;  // a spring's, where a slip's symbol would reach further down [px]
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Network network = testing::random_network(seed, {.most_nodes = 12, .most_slips = 3});
    const Inside inside = tree_layout(*series_parallel_tree(network), network);
    double highest = inside.height, lowest = 0;
    for (const Place& place : ink(inside.svg)) highest = std::min(highest, place.y), lowest = std::max(lowest, place.y);
    EXPECT_LE(highest, label_rise);
    EXPECT_GE(lowest, inside.height - (symbol_drop - lightest_drop));
    EXPECT_LE(lowest, inside.height);
  }
}

// If this fails, the simplest network that is no tree is drawn with wires that cross: the bridge's own node joins the
// damper above and the spring in the middle, the other one the middle and the damper below.
TEST(RailLayout, DrawsABridgeWithoutCrossings) {
  const Network network = written_network(
      R"([{"spring": 1, "nodes": ["tool", "a"], "name": "K1"}, {"damper": 1, "nodes": ["tool", "b"], "name": "B1"}, {"spring": 1, "nodes": ["a", "b"], "name": "K2"},
          {"damper": 1, "nodes": ["a", "ground"], "name": "B2"}, {"spring": 1, "nodes": ["b", "ground"], "name": "K3"}])");
  const std::vector<Label> all = labels(rail_layout(network).svg);
  const double row = label(all, "K2").y;
  EXPECT_EQ(label(all, "K1").y, row);
  EXPECT_EQ(label(all, "K3").y, row);
  EXPECT_LT((label(all, "B1").y - row) * (label(all, "B2").y - row), 0);
}

// If this fails, a long name runs into its neighbours.
TEST(Symbols, MakeRoomForTheirWords) {
  Element element{"K", Spring{1}, tool, ground, {}, {}};
  const double usual = element_length(element, motion::translation);
  element.name = "a_very_long_name_of_a_spring";
  EXPECT_GT(element_length(element, motion::translation), usual + 80);
}

// If this fails, a contact is drawn like a network that is always touched.
TEST(Schematic, ShowsTheGapOfAContact) {
  Network network = written_network(R"({"spring": 5})");
  const std::string without = schematic(network);
  network.contact = Contact{0, {}};
  EXPECT_GT(schematic(network).size(), without.size());
}

}  // namespace
}  // namespace dashpot::compiler
