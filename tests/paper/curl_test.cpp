#include "curl.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <laws.hpp>

#include "says.hpp"

namespace {

using namespace dashpot::paper;

const Curl& curl() {
  static const Curl measured = measure_curl();
  return measured;
}

// Fails if the gate's edge is elsewhere: a brake that is 5 % short pays for 0.95 of the joints' damping, of which the
// gate keeps 2 % of the least in the workspace, or nine tenths of that, for limits that grow.
TEST(Curl, PassesWholeUpToTheEdge) {
  EXPECT_TRUE(laws::curl::certified_for::is_certified);
  EXPECT_NEAR(curl().limit, 0.95 * (1 - 0.019), 0.95 * 0.001 + 1e-5);
  for (const Curl::Place& place : curl().places)
    EXPECT_NEAR(place.passed * place.wanted, std::min(place.wanted, curl().limit), 1e-12) << place.angle;
  EXPECT_NEAR(curl().at(48).passed, 1, 1e-12);
  EXPECT_LT(curl().at(54).passed, 1);
}

// Fails if without a gate the power is not 1 − ε − γ|σ|/p of the joints' own: circles of 1 mrad change r and σ by as
// much, which over a turn is less than 1e-5 of them.
TEST(Curl, GivesEnergyWithoutAGate) {
  for (const Curl::Place& place : curl().places) EXPECT_NEAR(place.ungated_power, place.expected, 1e-4) << place.angle;
  EXPECT_LT(curl().at(90).ungated_power, -0.2);
  EXPECT_LT(least_taken(curl().at(90).ungated), -1e-4);
}

// Fails if energy comes out behind the gate at any time, at its edge or beyond; a motion begins with nothing taken.
TEST(Curl, NeverGivesEnergyBehindItsGate) {
  for (const Curl::Place& place : curl().places) {
    EXPECT_GE(least_taken(place.gated), 0) << place.angle;
    EXPECT_GT(place.gated_power, 0) << place.angle;
  }
}

// Fails if the gate takes much more than it has to: beyond its edge (γ = 0.977) 0.95 − γ · 0.931 of the damping's own
// is left.
TEST(Curl, GivesLittleAwayBeyondItsEdge) { EXPECT_NEAR(curl().at(90).gated_power, 0.95 - 0.977 * 0.931, 2e-3); }

// Fails if inside the edge the gate is felt at all, once it has opened.
TEST(Curl, IsNotFeltInsideItsEdge) { EXPECT_NEAR(curl().at(48).gated_power, curl().at(48).ungated_power, 1e-9); }

// Fails if the words stay when the numbers change sides.
TEST(Curl, SaysWhatTheNumbersSay) {
  EXPECT_TRUE(says(show(curl()), "gate it never gives energy"));
  EXPECT_TRUE(says(show(curl()), "Without a gate it gives up to 0.22"));
  Curl other = curl();
  for (Curl::Place& place : other.places) place.gated_power = -0.01, place.ungated_power = 0.3;
  EXPECT_TRUE(says(show(other), "gate it gives energy"));
  EXPECT_TRUE(says(show(other), "Without a gate it leaves"));
}

}  // namespace
