#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <thread>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>

#include "scripted_device.hpp"
#include "scripted_model.hpp"

namespace dashpot::tests {
namespace {

// A minute in RealClock.MinuteAtOneKilohertz (CMakeLists.txt).
double seconds() {
  const char* const text = std::getenv("DASHPOT_REALTIME_SECONDS");
  return text != nullptr ? std::atof(text) : 2.0;
}

device_description patient_description() {
  device_description device = scripted_description();
  device.loop.missed_deadlines_allowed = 1'000'000;  // an ordinary kernel stalls as it likes
  return device;
}

// The scripted device forgets what was written, so that a minute of it needs no more memory than a second.
class forgetful_device {
 public:
  device_status read(device_sample& sample) noexcept {
    sample.position = 0.02 * std::sin(0.01 * static_cast<double>(reads_));
    sample.sequence = ++reads_;
    return device_status::ok;
  }
  device_status write(const actuation& wanted) noexcept {
    last_ = wanted;
    return device_status::ok;
  }
  const device_description& description() const noexcept { return description_; }
  std::uint32_t reads() const noexcept { return reads_; }
  const actuation& last() const noexcept { return last_; }

 private:
  device_description description_ = patient_description();
  std::atomic<std::uint32_t> reads_{0};
  actuation last_;
};

std::uint64_t lines_in(std::FILE* file) {
  std::rewind(file);
  std::uint64_t lines = 0;
  for (int letter = std::fgetc(file); letter != EOF; letter = std::fgetc(file)) lines += letter == '\n' ? 1 : 0;
  return lines;
}

// Broken, a loop at 1 kHz on an ordinary kernel would not finish, lose periods or records without counting them, or
// leave the device with the motor on. Its jitter is printed and never asserted: it is the machine's.
TEST(RealClock, LoopAtOneKilohertzFinishes) {
  forgetful_device device;
  scripted_model model;
  any_estimator<double> estimator(device.description().velocity, 0.001, device.description().encoder.step);
  servo_options options;
  options.duration = seconds();
  std::FILE* const csv = std::tmpfile();
  options.outputs.csv = csv;
  servo_loop loop(model, device, estimator, options);
  const servo_summary summary = loop.run();
  std::cout << to_text(summary);
  EXPECT_EQ(summary.periods + summary.missed_deadlines, static_cast<std::uint64_t>(options.duration * 1000 + 0.5));
  EXPECT_EQ(summary.faults.total(), 0u);
  EXPECT_TRUE(summary.left_safe);
  EXPECT_EQ(device.last().motor_torque, 0);
  EXPECT_EQ(lines_in(csv) + summary.telemetry_dropped, summary.periods + 1);
  std::fclose(csv);
}

// Broken, a writer that hangs, on a full disk or a slow terminal, would hold up the loop or lose records uncounted.
TEST(RealClock, StalledWriterDropsAndCountsAndNeverBlocks) {
  forgetful_device device;
  scripted_model model;
  any_estimator<double> estimator(device.description().velocity, 0.001, device.description().encoder.step);
  servo_options options;
  options.telemetry_capacity = 64;
  options.outputs.log = nullptr;
  std::uint64_t observed = 0;
  servo_control* control = nullptr;
  options.outputs.observe = [&](const telemetry_record&) {
    if (observed++ != 0) return;
    // Nothing is read until the loop has gone on without its writer for more periods than the ring holds.
    const std::uint32_t stalled_at = device.reads();
    while (device.reads() < stalled_at + 150) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    control->stop();
  };
  servo_loop loop(model, device, estimator, options);
  control = &loop.control();
  const servo_summary summary = loop.run();
  EXPECT_GT(summary.telemetry_dropped, 0u);
  EXPECT_EQ(observed + summary.telemetry_dropped, summary.periods);
}

// Broken, a stop from another thread or a signal would be seen late or never.
TEST(RealClock, StopsFromAnotherThread) {
  forgetful_device device;
  scripted_model model;
  any_estimator<double> estimator(device.description().velocity, 0.001, device.description().encoder.step);
  servo_options options;
  options.outputs.log = nullptr;
  servo_loop loop(model, device, estimator, options);
  std::thread stopper([&] {
    while (device.reads() < 50) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    loop.control().stop();
  });
  const servo_summary summary = loop.run();
  stopper.join();
  EXPECT_GE(summary.periods, 50u);
  EXPECT_TRUE(summary.left_safe);
}

}  // namespace
}  // namespace dashpot::tests
