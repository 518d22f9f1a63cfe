// What holds behind slips at most (theory, section 11).
#include "certify/forces_behind_slips.hpp"

#include <gtest/gtest.h>

#include "support/written_network.hpp"

namespace dashpot::compiler {
namespace {

using dashpot::testing::written_network;

void expect_forces(const std::string& network, double stiffness, double yields) {
  const ForcesBehindSlips forces = forces_behind_slips(written_network(network));
  EXPECT_EQ(forces.reach_round, stiffness > 0) << network;
  EXPECT_NEAR(forces.stiffness, stiffness, 1e-12 * stiffness) << network;
  EXPECT_NEAR(forces.yields, yields, 1e-12 * yields) << network;
}

// If this failed, what lies beside slips would count twice, or a slip in series would let more through than it holds.
TEST(ForcesBehindSlips, OfASlipInSeriesIsItsYieldForce) {
  expect_forces(
      R"({ "parallel": [ { "spring": 50 }, { "damper": 3 }, { "series": [ { "spring": 300 }, { "slip": 2 } ] },
      { "series": [ { "spring": 7 }, { "damper": 2 } ] } ] })",
      0, 2);
  expect_forces(
      R"({ "series": [ { "spring": 300 }, { "slip": 2 }, { "damper": 9 }, { "slip": 0.5 }, { "slip": 4 } ] })", 0, 0.5);
}

// If this failed, a spring that goes on pulling when the slip beside it has given way would not count.
TEST(ForcesBehindSlips, HaveTheSpringsRoundThem) {
  expect_forces(R"({ "series": [ { "spring": 100 }, { "parallel": [ { "slip": 2 }, { "spring": 300 } ] } ] })", 75,
                0.25 * 2);
  expect_forces(R"([ { "nodes": ["tool", "p"], "spring": 100 }, { "nodes": ["tool", "q"], "spring": 60 },
      { "nodes": ["p", "ground"], "slip": 1 }, { "nodes": ["q", "ground"], "spring": 60 },
      { "nodes": ["p", "q"], "spring": 30 } ])",
                1080 / 31.0, 28 / 31.0);
}

// If this failed, a damper beside a slip would not relax what the spring before it holds.
TEST(ForcesBehindSlips, HaveTheDampersRoundThem) {
  expect_forces(R"({ "series": [ { "spring": 100 }, { "parallel": [ { "slip": 2 }, { "damper": 4 } ] } ] })", 100, 2);
}

}  // namespace
}  // namespace dashpot::compiler
