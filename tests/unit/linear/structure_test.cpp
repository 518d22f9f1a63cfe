// Networks at the edges of what can be written: one element, one kind, a thousand branches, zeros by structure.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "linear_form_of.hpp"
#include "linear/modal_reduction.hpp"
#include "support/shrink.hpp"
#include "support/written_network.hpp"

namespace {

using namespace dashpot::testing;
using namespace dashpot::compiler;

// Fails if a lone spring is anything but itself.
TEST(Structure, OneSpring) {
  const LinearForm form = form_of(R"({ "spring": 12.5 })");
  EXPECT_EQ(form.static_stiffness, 12.5);
  EXPECT_EQ(form.feedthrough_damping, 0);
  EXPECT_TRUE(form.modes.empty());
}

// Fails if a lone damper is anything but itself.
TEST(Structure, OneDamper) {
  const LinearForm form = form_of(R"({ "damper": 12.5 })");
  EXPECT_EQ(form.static_stiffness, 0);
  EXPECT_EQ(form.feedthrough_damping, 12.5);
  EXPECT_TRUE(form.modes.empty());
}

// Fails if a network whose elements are all zero is anything but nothing.
TEST(Structure, ZeroSpring) {
  const LinearForm form = form_of(R"({ "spring": 0 })");
  EXPECT_EQ(form.static_stiffness, 0);
  EXPECT_EQ(form.feedthrough_damping, 0);
  EXPECT_TRUE(form.modes.empty());
}

// Fails if rounding leaves a mode where nodes are held by springs only or by dampers only.
TEST(Structure, OneKindOfElementHasNoModes) {
  const LinearForm springs = form_of(R"({ "series": [ { "spring": 1 }, { "spring": 3 }, { "spring": 7 } ] })");
  EXPECT_TRUE(springs.modes.empty());
  EXPECT_EQ(springs.feedthrough_damping, 0);
  EXPECT_LT(abs(springs.static_stiffness - Real(21) / 31), rounding);
  const LinearForm dampers = form_of(R"({ "series": [ { "damper": 1 }, { "damper": 3 }, { "damper": 7 } ] })");
  EXPECT_TRUE(dampers.modes.empty());
  EXPECT_EQ(dampers.static_stiffness, 0);
  EXPECT_LT(abs(dampers.feedthrough_damping - Real(21) / 31), rounding);
}

// Fails if the paper's second-order model (Fig. 2e with the numbers of Fig. 5) loses its parameters.
TEST(Structure, ParallelBranchesKeepTheirParameters) {
  const LinearForm form = form_of(R"({ "parallel": [ { "series": [ { "damper": 5 }, { "spring": 12 } ] },
                                                     { "series": [ { "damper": 6 }, { "spring": 10 } ] },
                                                     { "spring": 5 } ] })");
  EXPECT_EQ(form.static_stiffness, 5);
  EXPECT_EQ(form.feedthrough_damping, 0);
  ASSERT_EQ(form.modes.size(), 2u);
  EXPECT_LT(abs(form.modes[0].stiffness - 10), rounding);
  EXPECT_LT(abs(form.modes[0].relaxation_rate - Real(10) / 6), rounding);
  EXPECT_LT(abs(form.modes[1].stiffness - 12), rounding);
  EXPECT_LT(abs(form.modes[1].relaxation_rate - Real(12) / 5), rounding);
}

std::string branches(int count) {
  std::string text;
  for (int i = 1; i <= count; ++i)
    text += fmt::format("{}{{ \"series\": [ {{ \"spring\": {} }}, {{ \"damper\": 1 }} ] }}", i == 1 ? "" : ",", i);
  return "{ \"parallel\": [" + text + "] }";
}

// Fails if a thousand Maxwell branches are not a thousand independent modes, each with the constants of its branch.
TEST(Structure, AThousandBranches) {
  const Network network = written_network(branches(1000));
  std::vector<std::size_t> all(network.elements.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  EXPECT_EQ(independent_parts(network, all, tool, ground).size(), 1000u);
  const LinearForm form = linear_form(network);
  ASSERT_EQ(form.modes.size(), 1000u);
  for (int i = 1; i <= 1000; ++i) {
    const Mode& mode = form.modes[static_cast<std::size_t>(i - 1)];
    ASSERT_LT(abs(mode.stiffness - i), i * rounding);
    ASSERT_LT(abs(mode.relaxation_rate - i), i * rounding);
    ASSERT_EQ(mode.elements.size(), 2u);
  }
}

// Fails if `nodal` states were told that a mode's drive comes through springs when it comes through dampers.
TEST(Structure, ModesKnowWhatDrivesThem) {
  const LinearForm damper_at_tool = form_of(R"({ "series": [ { "damper": 5 }, { "spring": 50 } ] })");
  const LinearForm spring_at_tool = form_of(R"({ "series": [ { "spring": 50 }, { "damper": 5 } ] })");
  EXPECT_LT(abs(damper_at_tool.modes.at(0).spring_share), rounding);
  EXPECT_LT(abs(spring_at_tool.modes.at(0).spring_share - 1), rounding);
}

}  // namespace
