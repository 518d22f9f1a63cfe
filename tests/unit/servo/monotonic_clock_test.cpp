#include <gtest/gtest.h>

#include <string>

#include <dashpot/servo/monotonic_clock.hpp>

#include "loop_fixture.hpp"

namespace dashpot::tests {
namespace {

// A machine whose clocks a test moves. Every reading of a clock takes 50 ns, as on a real one.
struct machine {
  static inline std::int64_t awake = 0;   // [ns]
  static inline std::int64_t asleep = 0;  // [ns]
  static inline std::uint64_t sleeps = 0;
  static inline std::uint64_t suspended_at = 0;  // the sleep during which it is suspended
  static inline std::int64_t suspended_for = 0;  // [ns]

  static std::int64_t since_boot() noexcept { return (awake += 50) + asleep; }
  static std::int64_t time_awake() noexcept { return awake += 50; }
  static void sleep_until(std::int64_t instant) noexcept {
    if (++sleeps == suspended_at) asleep += suspended_for;
    if (awake + asleep < instant) awake = instant - asleep;
  }
  static const machine_time& time() {
    static constexpr machine_time these{since_boot, time_awake, sleep_until};
    return these;
  }
  static void restart(std::uint64_t at, std::int64_t duration) {
    awake = 1'000'000'000, asleep = 5'000'000'000, sleeps = 0, suspended_at = at, suspended_for = duration;
  }
};

constexpr std::int64_t hour = 3'600'000'000'000;  // [ns]

// CLOCK_MONOTONIC stands still while the machine sleeps: on it no deadline is ever missed by that.
TEST(MonotonicClock, KnowsThatTheMachineSlept) {
  machine::restart(10, hour);
  monotonic_clock clock(machine::time());
  clock.start(0.001);
  for (int period = 0; period < 9; ++period) {
    const wake_up woken = clock.wait();
    EXPECT_EQ(woken.asleep, 0);
    EXPECT_EQ(woken.missed, 0u);
  }
  const wake_up woken = clock.wait();
  EXPECT_NEAR(static_cast<double>(woken.asleep), static_cast<double>(hour), 1000);
  EXPECT_EQ(woken.missed, 3'600'000u - 1);
  EXPECT_EQ(clock.wait().asleep, 0);
}

// What was asleep before the loop began is no business of the loop's.
TEST(MonotonicClock, ForgetsWhatWasBeforeItsStart) {
  machine::restart(0, 0);
  monotonic_clock clock(machine::time());
  clock.start(0.001);
  EXPECT_EQ(clock.wait().asleep, 0);
}

// A handle that somebody has moved, or a device that has been switched off: after an hour nothing is as it was.
TEST(MonotonicClock, LoopThatResumesIsSafeAndSaysWhy) {
  machine::restart(20, hour);
  device_description patient = scripted_description();
  patient.loop.missed_deadlines_allowed = most_missed_deadlines;
  scripted_device device(patient);
  scripted_model model;
  scripted_estimator estimator;
  log_text log;
  servo_options options;
  options.outputs.log = log.file();
  options.realtime = {0, false, false};
  servo_loop loop(model, device, estimator, options, monotonic_clock(machine::time()));
  device.on_write([&](std::size_t write) {
    if (write == 40) loop.control().stop();
    return device_status::ok;
  });
  const servo_summary summary = loop.run();
  EXPECT_EQ(summary.faults.of(fault::suspended), 1u);
  ASSERT_GT(device.written().size(), 30u);
  for (std::size_t k = 0; k < device.written().size(); ++k)
    EXPECT_EQ(device.written()[k].motor_torque == 0 && device.written()[k].brake_damping == 7.5, k >= 19) << k;
  EXPECT_NE(log.text().find(": safe: suspended: the machine was asleep for 3600 s"), std::string::npos) << log.text();
}

// The real one: time passes, and a machine that does not sleep is not said to have slept.
TEST(MonotonicClock, SeesNoSleepWhereThereIsNone) {
  monotonic_clock clock;
  clock.start(0.0001);
  std::int64_t before = -1;
  for (int period = 0; period < 100; ++period) {
    const wake_up woken = clock.wait();
    EXPECT_EQ(woken.asleep, 0);
    EXPECT_GT(woken.instant, before);
    before = woken.instant;
  }
}

}  // namespace
}  // namespace dashpot::tests
