#include <gtest/gtest.h>

#include <dashpot/servo/safety_monitor.hpp>

#include "scripted_device.hpp"

namespace dashpot::tests {
namespace {

device_sample sample_at(double position, std::uint32_t sequence) {
  device_sample sample;
  sample.position = position;
  sample.sequence = sequence;
  return sample;
}

class SafetyMonitor : public testing::Test {
 protected:
  // One period on time with a sample that is ok.
  fault_report step(double position, std::uint32_t sequence, unsigned missed = 0) {
    if (const fault_report found = monitor.check_wake_up(missed)) return found;
    return monitor.check_sample(device_status::ok, sample_at(position, sequence));
  }

  safety_monitor monitor{scripted_description()};
};

// Broken, the limits themselves would be refused, or something beyond them admitted.
TEST_F(SafetyMonitor, RangeIncludesItsEnds) {
  EXPECT_FALSE(step(0.1, 1));
  EXPECT_FALSE(safety_monitor(scripted_description()).check_sample(device_status::ok, sample_at(-0.1, 1)));
  monitor.restart();
  EXPECT_EQ(step(0.1 + 1e-12, 2).kind, fault::position_out_of_range);
}

// Broken, two samples a period and the stated jitter apart, each rounded by a step, would be taken for a jump.
TEST_F(SafetyMonitor, JumpLimitIsSpeedTimesPeriodAndJitterPlusOneStep) {
  constexpr double limit = 2.0 * (0.001 + 0.0001) + 1e-5;
  ASSERT_FALSE(step(0, 1));
  EXPECT_FALSE(step(limit - 1e-12, 2));
  const fault_report found = step(2 * limit, 3);
  EXPECT_EQ(found.kind, fault::encoder_jump);
  EXPECT_DOUBLE_EQ(found.seen, limit + 1e-12);
  EXPECT_DOUBLE_EQ(found.limit, limit);
}

// Broken, the first sample after a start would be held against one from before it.
TEST_F(SafetyMonitor, RestartForgetsThePosition) {
  ASSERT_FALSE(step(-0.09, 1));
  monitor.restart();
  EXPECT_FALSE(step(0.09, 1));
  EXPECT_EQ(monitor.periods_since_last(), 1u);
}

// Broken, a run after a fault would start with the patience that the run before it had left.
TEST_F(SafetyMonitor, RestartForgetsEverythingThatWasCounted) {
  ASSERT_FALSE(step(0, 1));
  ASSERT_FALSE(monitor.check_wake_up(3));
  for (int period = 0; period < 10; ++period) ASSERT_FALSE(monitor.check_saturation(true));
  for (int period = 0; period < 3; ++period) ASSERT_FALSE(monitor.check_write(device_status::stale));
  monitor.restart();
  EXPECT_FALSE(monitor.check_wake_up(1));
  EXPECT_FALSE(monitor.check_sample(device_status::no_data, {}));
  EXPECT_FALSE(step(0, 2));
  EXPECT_FALSE(monitor.check_saturation(true));
  EXPECT_FALSE(monitor.check_write(device_status::stale));
}

// Broken, the tool's ordinary motion during a missed deadline would be taken for a jump.
TEST_F(SafetyMonitor, MissedPeriodsWidenTheJumpLimit) {
  ASSERT_FALSE(step(0, 1));
  EXPECT_FALSE(step(0.006, 2, 2));
  EXPECT_EQ(monitor.periods_since_last(), 3u);
  EXPECT_EQ(step(0.012, 3).kind, fault::encoder_jump);
}

// Broken, samples that the device lost would be taken for a jump, or a wild number would switch the check off.
TEST_F(SafetyMonitor, LostSamplesWidenTheJumpLimitUpToTheAllowedNumber) {
  ASSERT_FALSE(step(0, 1));
  EXPECT_FALSE(step(0.006, 4));
  EXPECT_EQ(monitor.periods_since_last(), 3u);
  EXPECT_EQ(step(0.026, 1'000'000).kind, fault::encoder_jump);
  EXPECT_FALSE(step(0.014, 1'000'000));
  EXPECT_EQ(monitor.periods_since_last(), 4u);
}

// Broken, an overtaken or repeated sample would move the model backwards in time.
TEST_F(SafetyMonitor, OnlyANewerSequenceNumberIsFresh) {
  ASSERT_FALSE(step(0, 0xFFFFFFFFu));
  EXPECT_FALSE(step(0.001, 0xFFFFFFFFu));
  EXPECT_FALSE(monitor.is_fresh());
  EXPECT_FALSE(step(0.001, 0xFFFFFFFEu));
  EXPECT_FALSE(monitor.is_fresh());
  EXPECT_FALSE(step(0.001, 0));
  EXPECT_TRUE(monitor.is_fresh());
  EXPECT_EQ(monitor.periods_since_last(), 3u);
}

// Broken, single late wake-ups far apart would add up to a fault, or a long stall count as one.
TEST_F(SafetyMonitor, OnlyMissedDeadlinesInARowCount) {
  for (std::uint32_t k = 1; k < 40; k += 2) {
    ASSERT_FALSE(step(0, k, 3));
    ASSERT_FALSE(step(0, k + 1));
  }
  EXPECT_FALSE(step(0, 50, 2));
  EXPECT_FALSE(step(0, 51, 1));
  const fault_report found = step(0, 52, 1);
  EXPECT_EQ(found.kind, fault::missed_deadlines);
  EXPECT_EQ(found.seen, 4);
  EXPECT_EQ(found.limit, 3);
}

// Broken, a fresh sample would not end a silence, or the silence while the host slept would not count.
TEST_F(SafetyMonitor, SilenceIsCountedInPeriodsNotInReads) {
  ASSERT_FALSE(step(0, 1));
  const device_sample nothing{};
  for (int period = 0; period < 3; ++period) EXPECT_FALSE(monitor.check_sample(device_status::no_data, nothing));
  ASSERT_FALSE(step(0, 2));
  ASSERT_FALSE(monitor.check_wake_up(3));
  const fault_report found = monitor.check_sample(device_status::stale, nothing);
  EXPECT_EQ(found.kind, fault::no_data);
  EXPECT_EQ(found.seen, 4);
}

// Broken, an interrupted saturation would be summed up, or one of exactly the stated length be a fault.
TEST_F(SafetyMonitor, OnlyUninterruptedSaturationCounts) {
  ASSERT_FALSE(step(0, 1));
  for (int round = 0; round < 5; ++round) {
    for (int period = 0; period < 10; ++period) ASSERT_FALSE(monitor.check_saturation(true)) << period;
    ASSERT_FALSE(monitor.check_saturation(false));
  }
  for (int period = 0; period < 10; ++period) ASSERT_FALSE(monitor.check_saturation(true));
  const fault_report found = monitor.check_saturation(true);
  EXPECT_EQ(found.kind, fault::motor_saturated);
  EXPECT_DOUBLE_EQ(found.seen, 0.011);
  EXPECT_DOUBLE_EQ(found.limit, 0.01);
}

// Broken, a device that states no limit could not be used at all.
TEST(SafetyMonitorWithoutLimits, ChecksOnlyWhatMustBeFinite) {
  safety_monitor monitor{device_description{}};
  EXPECT_FALSE(monitor.check_sample(device_status::ok, sample_at(-1e9, 1)));
  EXPECT_FALSE(monitor.check_sample(device_status::ok, sample_at(1e9, 2)));
  EXPECT_FALSE(monitor.check_velocity(1e12));
  for (int period = 0; period < 100'000; ++period) ASSERT_FALSE(monitor.check_saturation(true));
}

}  // namespace
}  // namespace dashpot::tests
