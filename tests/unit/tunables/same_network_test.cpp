// A law with tunables at its default values against the law of the same network without any, which is made in another
// way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/shrink.hpp"
#include "support/tunable_run.hpp"

namespace dashpot::testing {
namespace {

constexpr double sample_period = 1e-3;  // [s]

std::string without_tunables(std::string text) {
  for (std::size_t at; (at = text.find(", \"tunable\": true")) != text.npos;) text.erase(at, text.find('}', at) - at);
  return text;
}

// The largest difference of the whole force, relative to its largest value.
double difference(const std::string& text, std::uint64_t seed, compiler::Scheme scheme) {
  compiler::Choices choices;
  choices.scheme = scheme;
  choices.state_input = compiler::StateInput::position;
  choices.decomposition = "velocity-free";
  const TunableLaw tunable(text, choices), plain(without_tunables(text), choices);
  compiler::Evaluation<double> here(tunable.law()), there(plain.law());
  Random random(seed);
  double last = 0, scale = 0, worst = 0;
  for (double position : random_walk(random, 300)) {
    const double velocity = (position - last) / sample_period;
    const command<double> a = here.step(position, velocity), b = there.step(position, velocity);
    const double of_a = a.damping * velocity + a.force, of_b = b.damping * velocity + b.force;
    scale = std::max({scale, std::abs(of_b), std::abs(b.damping * velocity), std::abs(b.force)});
    // At the very place of a surface rounding decides whether it is touched, and with that about b v̂.
    const bool either = (a.damping == 0) != (b.damping == 0) && std::abs(a.force - b.force) <= 1e-12 * scale;
    worst = std::max(worst, either ? 0 : std::abs(of_a - of_b));
    last = position;
  }
  return scale > 0 ? worst / scale : worst;
}

// Modes lose digits where rates differ by decades, element states where they add up elongations: 300 samples' roundings
// at values over five decades.
constexpr double force_rounding = 1e-9;

void expect_same_forces(Kind kind, compiler::Scheme scheme) {
  for (std::uint64_t seed = 1; seed <= repetitions(60, 5000); ++seed) {
    const std::string text = tunable_network(seed, kind);
    ASSERT_LE(difference(text, seed, scheme), force_rounding) << "seed " << seed << ", " << text;
  }
}

// If this failed, a network would change its forces by having a slider.
TEST(SameNetwork, OfBranchesInTheExactScheme) { expect_same_forces(Kind::parallel_branches, compiler::Scheme::exact); }
TEST(SameNetwork, OfBranchesInBackwardEuler) {
  expect_same_forces(Kind::parallel_branches, compiler::Scheme::backward_euler);
}
TEST(SameNetwork, OfTreesInBackwardEuler) { expect_same_forces(Kind::tree, compiler::Scheme::backward_euler); }
TEST(SameNetwork, OfGraphsInBackwardEuler) { expect_same_forces(Kind::graph, compiler::Scheme::backward_euler); }
TEST(SameNetwork, OfSlipsInBackwardEuler) { expect_same_forces(Kind::slips, compiler::Scheme::backward_euler); }
TEST(SameNetwork, BehindAContactInTheExactScheme) { expect_same_forces(Kind::touched, compiler::Scheme::exact); }
TEST(SameNetwork, BehindAContactInBackwardEuler) {
  expect_same_forces(Kind::touched, compiler::Scheme::backward_euler);
}
TEST(SameNetwork, OfSlipsBehindAContactInBackwardEuler) {
  expect_same_forces(Kind::touched_slips, compiler::Scheme::backward_euler);
}
TEST(SameNetwork, OfSlipsOutsideTreesInBackwardEuler) {
  expect_same_forces(Kind::slips_in_graph, compiler::Scheme::backward_euler);
}
TEST(SameNetwork, OfSlipsOutsideTreesBehindAContactInBackwardEuler) {
  expect_same_forces(Kind::touched_slips_in_graph, compiler::Scheme::backward_euler);
}

// If this failed, what relaxes between two ends of slips would be stepped by backward Euler, though nothing else
// relaxes with it: a ring of three slips, a tunable Maxwell element and a tunable Kelvin element in series with a
// spring between their ends.
TEST(SameNetwork, OfOnePortsBetweenSlipsInTheExactScheme) {
  const char* const ring = R"({ "dashpot": 1, "name": "ring",
    "parameters": { "K": { "value": 300, "tunable": true, "min": 0, "max": 1000 }, "Y": { "value": 0.2, "tunable": true, "min": 0, "max": 1 } },
    "elements": [ { "spring": 500, "nodes": ["tool", "a"] }, { "slip": "Y", "nodes": ["a", "b"] }, { "slip": 0.3, "nodes": ["b", "c"] },
      { "slip": 0.1, "nodes": ["c", "a"] }, { "spring": "K", "nodes": ["b", "m"] }, { "damper": 3, "nodes": ["m", "ground"] },
      { "spring": 200, "nodes": ["c", "n"] }, { "spring": 50, "nodes": ["n", "ground"] }, { "damper": 2, "nodes": ["n", "ground"] } ] })";
  const TunableLaw law(ring);
  ASSERT_EQ(law.law().tunable->graphs.size(), 1u);
  EXPECT_TRUE(law.law().tunable->mesh_elements.empty());
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_LE(difference(ring, seed, compiler::Scheme::exact), force_rounding) << seed;
}

// If this failed, an inner node that three ends of slips share would be lost, or its springs take another way.
TEST(SameNetwork, OfStarsBetweenSlipsInBackwardEuler) {
  const char* const star = R"({ "dashpot": 1, "name": "star",
    "parameters": { "K": { "value": 300, "tunable": true, "min": 0, "max": 1000 } },
    "elements": [ { "spring": 500, "nodes": ["tool", "a"] }, { "slip": 0.2, "nodes": ["a", "b"] }, { "slip": 0.3, "nodes": ["b", "c"] },
      { "spring": "K", "nodes": ["a", "m"] }, { "damper": 3, "nodes": ["b", "m"] }, { "damper": 4, "nodes": ["m", "n"] },
      { "spring": 200, "nodes": ["n", "c"] }, { "spring": 50, "nodes": ["c", "ground"] }, { "damper": 2, "nodes": ["n", "ground"] } ] })";
  const TunableLaw law(star);
  ASSERT_EQ(law.law().tunable->graphs.size(), 1u);
  EXPECT_EQ(law.law().tunable->ends, 5);
  EXPECT_EQ(law.law().tunable->mesh_elements.size(), 5u);
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_LE(difference(star, seed, compiler::Scheme::backward_euler), force_rounding) << seed;
}

}  // namespace
}  // namespace dashpot::testing
