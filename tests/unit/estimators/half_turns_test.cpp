// The design functions against the mathematics library.

#include <cmath>

#include <gtest/gtest.h>

#include <dashpot/estimators/half_turns.hpp>

namespace dashpot {
namespace {

// A filter prewarped by a wrong tangent has another cutoff. Four units in the last place, with the library's own error,
// and that of π·x, whose effect on the tangent grows as 1/(½ − x) towards the pole.
TEST(HalfTurns, AgreeWithTheLibrary) {
  for (int i = 1; i < 5000; ++i) {
    const double half_turns = i / 10000.0;
    const double tangent = std::tan(pi * half_turns);
    EXPECT_NEAR(sine_of_half_turns(half_turns), std::sin(pi * half_turns), 4 * 2.3e-16) << half_turns;
    EXPECT_NEAR(tangent_of_half_turns(half_turns), tangent, 4 * 2.3e-16 * tangent / (1 - 2 * half_turns)) << half_turns;
  }
}

// Small angles, of filters slow against their sample rate, must keep all their digits.
TEST(HalfTurns, KeepDigitsOfSmallAngles) {
  for (double half_turns = 1e-12; half_turns < 0.1; half_turns *= 3)
    EXPECT_NEAR(tangent_of_half_turns(half_turns) / std::tan(pi * half_turns), 1, 4 * 2.3e-16) << half_turns;
}

// A firmware pays for its filter's design unless the compiler can do it.
static_assert(tangent_of_half_turns(0.25) == 1);
static_assert(sine_of_half_turns(0.5) == 1);
static_assert(sine_of_half_turns(0) == 0);

}  // namespace
}  // namespace dashpot
