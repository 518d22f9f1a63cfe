// The difference of two positions over the time between them.

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <dashpot/estimators/backward_difference.hpp>
#include <dashpot/estimators/interval_difference.hpp>

namespace dashpot::interval_difference_test {
namespace {

constexpr double sample_period = 1e-3;          // [s]
constexpr std::uint64_t period_ns = 1'000'000;  // [ns]
constexpr double rounding = 4 * 0x1p-52;        // of a difference, a product and a quotient

// If this failed, a steady motion would seem to jerk with the clock, as it does for a difference over the nominal
// period: by a tenth, for samples a tenth of a period early or late.
TEST(IntervalDifference, OfASteadyMotionIsItsVelocityWhateverTheClockDoes) {
  interval_difference<double> by_interval(sample_period);
  backward_difference<double> by_period(1, sample_period);
  std::mt19937 random(3);
  std::uniform_int_distribution<int> late(-50'000, 50'000);
  constexpr double velocity = 0.25;  // [m/s]
  double largest = 0;
  by_interval.reset(0);
  by_period.reset(0);
  for (std::uint64_t k = 1; k < 1000; ++k) {
    const std::uint64_t time_ns = k * period_ns + static_cast<std::uint64_t>(late(random));
    const double position = velocity * (static_cast<double>(time_ns) * 1e-9);
    const double estimate = by_interval.update(position, time_ns);
    const double nominal = by_period.update(position);
    if (k == 1) continue;                         // before it there is no sample, and so no time
    EXPECT_NEAR(estimate, velocity, 1e-12) << k;  // positions up to 0.25 m, rounded, over at least 0.9 ms
    largest = std::max(largest, std::abs(nominal - velocity));
  }
  EXPECT_GT(largest, 0.08 * velocity);
}

// At a constant period it has to be the difference that the certificate takes it for.
TEST(IntervalDifference, OfPunctualSamplesIsTheBackwardDifference) {
  interval_difference<double> by_interval(sample_period);
  backward_difference<double> by_period(1, sample_period);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  by_interval.reset(0.1);
  by_period.reset(0.1);
  for (std::uint64_t k = 7; k < 1000; ++k) {
    const double position = anywhere(random), expected = by_period.update(position);
    EXPECT_NEAR(by_interval.update(position, k * period_ns), expected, rounding * std::abs(expected)) << k;
  }
}

// If this failed, a division by zero, or by the leap of a clock that starts anew, would reach the motor; and what the
// tool has moved in the meantime must not be forgotten.
TEST(IntervalDifference, IsNumberWhateverTheClockDoes) {
  interval_difference<double> estimator(sample_period);
  estimator.reset(1);
  EXPECT_NEAR(estimator.update(1.001, 5), 1, 1e-12);
  EXPECT_EQ(estimator.update(1.002, 5), 0);  // no time has passed: wait
  EXPECT_NEAR(estimator.update(1.003, 5 + 2 * period_ns), 1, 1e-12);
  EXPECT_EQ(estimator.update(2, 3), 0);  // the clock has run back: begin anew, from there
  EXPECT_NEAR(estimator.update(2.001, 3 + period_ns), 1, 1e-12);
  const std::uint64_t end = std::numeric_limits<std::uint64_t>::max();
  estimator.update(3, end - period_ns / 2 + 1);
  estimator.reset(3);
  estimator.update(3, end - period_ns / 2 + 1);
  EXPECT_NEAR(estimator.update(3.001, period_ns - period_ns / 2), 1, 1e-12);  // across the wrap
}

// If this failed, a run would begin with the displacement since the last one.
TEST(IntervalDifference, IsAtRestWhereItIsReset) {
  interval_difference<double> estimator(sample_period);
  estimator.update(5, 1'000);
  estimator.reset(-2);
  EXPECT_EQ(estimator.update(-2, 77), 0);
}

}  // namespace
}  // namespace dashpot::interval_difference_test
