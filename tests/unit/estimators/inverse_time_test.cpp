// Inverse time, edge by edge.

#include <gtest/gtest.h>

#include <dashpot/estimators/inverse_time.hpp>

#include "motion.hpp"

namespace dashpot::inverse_time_test {
namespace {

constexpr double step = 1e-4;            // [m]
constexpr double sample_period = 1e-3;   // [s]
constexpr std::uint64_t ms = 1'000'000;  // [ns]

inverse_time<double> started_at(std::uint64_t edge_time_ns) {
  inverse_time<double> estimator(step, sample_period);
  estimator.reset(0);
  estimator.update(0, edge_time_ns, edge_time_ns);
  return estimator;
}

// The law itself: counts over the time between edges, with the counts' sign.
TEST(InverseTime, IsCountsOverTheTimeBetweenEdges) {
  inverse_time<double> estimator = started_at(10 * ms);
  EXPECT_DOUBLE_EQ(estimator.update(3 * step, 14 * ms, 15 * ms), 3 * step / 4e-3);
  EXPECT_DOUBLE_EQ(estimator.update(-2 * step, 24 * ms, 25 * ms), -5 * step / 10e-3);
}

// Between edges the estimate stands until it would have crossed the next edge, and decays from there.
TEST(InverseTime, DecaysWhenTheNextEdgeIsOverdue) {
  inverse_time<double> estimator = started_at(10 * ms);
  const double fast = estimator.update(step, 12 * ms, 12 * ms);
  EXPECT_DOUBLE_EQ(fast, step / 2e-3);
  EXPECT_EQ(estimator.update(step, 12 * ms, 13 * ms), fast);
  EXPECT_EQ(estimator.update(step, 12 * ms, 14 * ms), fast);
  EXPECT_DOUBLE_EQ(estimator.update(step, 12 * ms, 17 * ms), step / 5e-3);
  EXPECT_DOUBLE_EQ(estimator.update(step, 12 * ms, 112 * ms), step / 100e-3);
}

// The bound is on the magnitude: a negative velocity decays towards zero and does not flip.
TEST(InverseTime, IsBoundedOnBothSides) {
  inverse_time<double> estimator = started_at(10 * ms);
  estimator.update(-step, 12 * ms, 12 * ms);
  EXPECT_DOUBLE_EQ(estimator.update(-step, 12 * ms, 22 * ms), -step / 10e-3);
}

// After a reversal the sign is known to be wrong until the first edge, and must be right from then on.
TEST(InverseTime, HasTheOldSignUntilTheFirstEdgeAfterAReversal) {
  inverse_time<double> estimator = started_at(10 * ms);
  EXPECT_GT(estimator.update(step, 12 * ms, 12 * ms), 0);
  EXPECT_GT(estimator.update(step, 12 * ms, 15 * ms), 0);
  EXPECT_LT(estimator.update(0, 16 * ms, 16 * ms), 0);
}

// An edge crossed forth and back between two samples is an edge without displacement.
TEST(InverseTime, IsZeroWhenTheCountReturns) {
  inverse_time<double> estimator = started_at(10 * ms);
  estimator.update(step, 12 * ms, 12 * ms);
  EXPECT_EQ(estimator.update(step, 13 * ms, 13 * ms), 0);
}

// Without edge times the samples' own times stand in, and the estimate is the difference over whole periods.
TEST(InverseTime, FallsBackOnSampleTimes) {
  inverse_time<double> estimator(step, sample_period);
  estimator.reset(0);
  estimator.update(0, 0, 10 * ms);
  EXPECT_DOUBLE_EQ(estimator.update(2 * step, 0, 12 * ms), 2 * step / 2e-3);
  EXPECT_DOUBLE_EQ(estimator.update(2 * step, 0, 16 * ms), step / 4e-3);
}

// A clock that jumps back must neither divide by zero nor turn the velocity round.
TEST(InverseTime, IgnoresAnEdgeThatRunsBackwards) {
  inverse_time<double> estimator = started_at(10 * ms);
  const double before = estimator.update(step, 12 * ms, 12 * ms);
  EXPECT_EQ(estimator.update(2 * step, 11 * ms, 12 * ms), before);
  EXPECT_EQ(estimator.update(2 * step, 12 * ms, 11 * ms), before);
}

// On a steady motion the estimate is exact, whatever the sampling; edge times are read to a nanosecond in 0.3 ms.
TEST(InverseTime, IsExactInSteadyMotion) {
  const double speed = 0.0313;
  sampled_motion samples(ramp(speed, 0), 1e-5, sample_period);
  inverse_time<double> estimator(1e-5, sample_period);
  while (samples.time() < 0.5) {
    const device_sample sample = samples.next();
    const double estimate = estimator.update(sample.position, sample.edge_time_ns, sample.timestamp_ns);
    if (samples.time() > 0.01) {
      EXPECT_NEAR(estimate, speed, 1e-5 * speed);
    }
  }
}

}  // namespace
}  // namespace dashpot::inverse_time_test
