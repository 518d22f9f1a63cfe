#include "fig7.hpp"

#include <gtest/gtest.h>

#include "says.hpp"

namespace {

using namespace dashpot::paper;

const Fig7& fig7() {
  static const Fig7 measured = measure_fig7();
  return measured;
}

// Fails if the encoder or the rate is not the paper's: its one-sample difference jumps by 0.95 rad/s.
TEST(Fig7, HasThePrintedQuantumOfVelocity) { EXPECT_NEAR(fig7().quantum, 0.95, 0.01); }

// Fails if the paper's filter has another delay than its order and cutoff give it. The paper says "approximately 5 ms":
// that does not come out, also not where the velocity crosses zero and the encoder is silent.
TEST(Fig7, IsLateByTheDelayOfTheFilter) {
  constexpr double tenth_of_a_millisecond = 1e-4;
  EXPECT_NEAR(fig7().estimates[1].delay, 3.5e-3, tenth_of_a_millisecond);
  EXPECT_GT(fig7().crossing_delay, fig7().estimates[1].delay);
  EXPECT_LT(fig7().crossing_delay, 4.2e-3);
}

// Fails if an estimator does not estimate: every one but the raw difference is nearer to the truth than that.
TEST(Fig7, ShowsWhatEveryEstimatorGainsOverTheRawDifference) {
  for (std::size_t i = 1; i < fig7().estimates.size(); ++i)
    EXPECT_LT(fig7().estimates[i].rms_error, fig7().estimates[0].rms_error / 3) << fig7().estimates[i].name;
}

// Fails if the tradeoff of section 6.2 is gone: less noise only for more delay, between the filters of both orders.
TEST(Fig7, PaysForSmoothnessWithDelay) {
  EXPECT_LT(fig7().estimates[1].noise, fig7().estimates[2].noise);
  EXPECT_GT(fig7().estimates[1].delay, fig7().estimates[2].delay + 1e-3);
}

// Fails if the strip of 7a does not show single switches: 10 ms of it hold a hundred samples.
TEST(Fig7, ShowsTenMillisecondsOfTheRawDifference) {
  const Panel& raw = show(fig7()).figures.at(0).panels.at(0);
  ASSERT_TRUE(raw.x_range.has_value());
  EXPECT_NEAR(raw.x_range->high - raw.x_range->low, 10e-3, 1e-12);
}

// Fails if the words stay when the numbers change sides.
TEST(Fig7, SaysWhatTheNumbersSay) {
  EXPECT_TRUE(says(show(fig7()), "crosses zero about 5 ms late. That does not come out"));
  Fig7 other = fig7();
  other.crossing_delay = 5e-3;
  EXPECT_TRUE(says(show(other), "crosses zero about 5 ms late. That comes out"));
  other.quantum = 0.5;
  EXPECT_TRUE(says(show(other), "the paper prints 0.95, which does not come out"));
}

}  // namespace
