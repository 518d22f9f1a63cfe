#include "limits.hpp"

#include <gtest/gtest.h>

#include "chosen.hpp"
#include "says.hpp"

namespace {

using namespace dashpot::paper;

const Limits& limits() {
  static const Limits measured = measure_limits(true);
  return measured;
}

constexpr double resolution = 1.06;  // of the search: 10^(1/48)

// Fails if a loop is rough by itself where it is smooth with steps, noise and jitter, but for the search's resolution.
TEST(Limits, IsSmoothOnlyWhereTheLoopIsStable) {
  for (const auto* rows : {&limits().rows, &limits().modes})
    for (const Limits::Row& row : *rows)
      for (const Limits::Bound& bound : {row.raw, row.filtered})
        EXPECT_LE(bound.smooth, resolution * bound.stable) << row.faults.name << row.faults.mode;
}

// Fails if the loop with the paper's filter does not turn unstable where its phase says: with Σ of the delays in the
// loop, 2.613/(2π·120 Hz) of the filter, half a sample of the difference, one and a half of the loop, 0.2 ms of the
// amplifier, half a sample of mean jitter, a shaft of inertia J under −B v̂(t − Σ) oscillates from B = (π/2) J/Σ on; the
// hand's damper r²·8 N·s/m beside it and the filter's own roll-off move that, by less than a third.
TEST(Limits, IsUnstableWhereTheDelaySays) {
  const double delay = 2.613 / (2 * 3.14159265358979323846 * 120) + 0.5e-4 + 1.5e-4 + 2e-4;
  const double expected = 1e3 * 3.14159265358979323846 / 2 * 1e-4 / delay;
  EXPECT_NEAR(limits().rows[0].filtered.stable, expected, expected / 3);
}

// Fails if the raw difference is not ended by the encoder's steps: one quantum of 0.96 rad/s times B, on or off half of
// the time, is a ripple of about B/2 · rad/s before the amplifier's lag smooths it, and the friction allows 1 mN·m.
TEST(Limits, IsEndedByTheEncodersStepsWithoutAFilter) {
  const Limits::Row& rigid = limits().rows[0];
  EXPECT_GT(rigid.raw.smooth, 1 / 0.48 / resolution);
  EXPECT_LT(rigid.raw.smooth, rigid.raw.stable / 5);
}

// Fails if a soft structure does not lower what the paper's filter can do, or a lighter arm does not.
TEST(Limits, FallsWithASoftStructureAndALightArm) {
  const auto& modes = limits().modes;  // frequency fastest, then inertia
  ASSERT_EQ(modes.size(), 4U);
  EXPECT_LT(modes[0].filtered.smooth, 0.8 * modes[1].filtered.smooth);
  EXPECT_LT(modes[3].filtered.smooth, 0.6 * modes[1].filtered.smooth);
}

// Fails if the words stay when the numbers change sides.
TEST(Limits, SaysWhatTheNumbersSay) {
  Limits other = limits();
  other.rows.back().raw.smooth = 2;
  other.rows.back().filtered.smooth = 20;
  EXPECT_TRUE(says(show(other), "the brake’s 7 mN·m·s. That comes out"));
  EXPECT_TRUE(says(show(other), "That comes out (3 to 30 times)"));
  other.rows.back().raw.smooth = 19;
  EXPECT_TRUE(says(show(other), "the brake’s 7 mN·m·s. That does not come out"));
  EXPECT_TRUE(says(show(other), "That does not come out (3 to 30 times)"));
  other.rows.back().raw.smooth = 7.1;
  EXPECT_TRUE(says(show(other), "the brake’s 7 mN·m·s. That is undecided"));
  for (Limits::Row& row : other.modes) row.filtered.smooth = 70;
  EXPECT_TRUE(says(show(other), "near 7 mN·m·s does not come out"));
  other.modes[0].filtered.smooth = 7.1;
  EXPECT_TRUE(says(show(other), "near 7 mN·m·s comes out"));
}

}  // namespace
