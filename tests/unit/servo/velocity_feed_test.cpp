#include <gtest/gtest.h>

#include <vector>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/velocity_feed.hpp>

namespace dashpot {
namespace {

device_sample moving_at(double velocity, unsigned period) {
  device_sample sample;
  sample.position = velocity * 0.001 * period;
  sample.velocity = velocity;
  sample.timestamp_ns = 1'000'000ull * period + 5'000'000;
  sample.sequence = period;
  return sample;
}

velocity_description with(estimator_kind kind) {
  velocity_description wanted;
  wanted.estimator = kind;
  wanted.window = 8;
  wanted.cutoff = 120;
  wanted.acceleration = 50;
  return wanted;
}

// Broken, every lost sample would be felt as a spike of several times the velocity.
TEST(VelocityFeed, AGapInSteadyMotionGoesUnnoticed) {
  for (const estimator_kind kind : all_estimators) {
    any_estimator<double> whole(with(kind), 0.001, 1e-6), gapped = whole;
    velocity_feed<any_estimator<double>> feed_whole(whole), feed_gapped(gapped);
    feed_whole.reset(moving_at(0.2, 0));
    feed_gapped.reset(moving_at(0.2, 0));
    for (unsigned period = 1; period <= 100; ++period) {
      const double expected = feed_whole.update(moving_at(0.2, period), 1);
      const bool lost = period % 10 == 3 || period % 10 == 4 || period % 10 == 5;
      if (lost) continue;
      const double estimate = feed_gapped.update(moving_at(0.2, period), period % 10 == 6 ? 4 : 1);
      // The two positions differ by rounding, which T = 1 ms and the estimator's gain below 1e4 amplify.
      EXPECT_NEAR(estimate, expected, 1e-9) << name_of(kind) << " " << period;
    }
  }
}

struct recording_estimator {
  std::vector<float> positions;
  float update(float position) noexcept {
    positions.push_back(position);
    return 0;
  }
  void reset(float position) noexcept { positions = {position}; }
  const char* name() const noexcept { return "recording"; }
};

// Broken, an estimator would see another number of samples than periods have passed, or samples off the line.
TEST(VelocityFeed, FillsAGapWithTheStraightLine) {
  recording_estimator estimator;
  velocity_feed<recording_estimator> feed(estimator);
  device_sample sample;
  sample.position = 1;
  feed.reset(sample);
  sample.position = 5;
  feed.update(sample, 4);
  EXPECT_EQ(estimator.positions, (std::vector<float>{1, 2, 3, 4, 5}));
}

struct recording_sensor {
  std::vector<double> velocities;
  double update(const device_sample& sample) noexcept {
    velocities.push_back(sample.velocity);
    return sample.velocity;
  }
  void reset(double) noexcept {}
  const char* name() const noexcept { return "recording"; }
};

// Broken, a filter behind a measured velocity would see steps where a sample is missing.
TEST(VelocityFeed, FillsAMeasuredVelocityToo) {
  recording_sensor estimator;
  velocity_feed<recording_sensor> feed(estimator);
  device_sample sample;
  feed.reset(sample);
  sample.velocity = 3;
  EXPECT_EQ(feed.update(sample, 3), 3);
  EXPECT_EQ(estimator.velocities, (std::vector<double>{1, 2, 3}));
}

}  // namespace
}  // namespace dashpot
