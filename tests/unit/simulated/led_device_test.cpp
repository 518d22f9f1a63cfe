// A device led along a motion by itself (led_device.hpp) is the simulated one without its mechanics, jitter and chance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <dashpot/led_device.hpp>

#include "plain_device.hpp"

namespace dashpot::simulated {
namespace {

// A spring and damper beside a brake: something that follows position and estimate.
struct plain_law {
  using scalar = double;
  command<double> step(double position, double velocity) noexcept {
    return {2 + 0.5 * std::sin(30 * position), 300 * position - 0.7 * velocity};
  }
};

// At rest at first.
double path(double time) {
  const double since = std::max(time - 0.01, 0.0);
  return 0.004 * (1 - std::cos(9 * since)) + 0.0005 * (1 - std::cos(70 * since));
}

// What a hand feels on a page would be something else than on the simulated device.
void expect_like_the_simulated(const device_description& device, double closeness = 1e-6) {
  const double period = device.loop.sample_period;
  scenario scene;
  scene.prescribed = true;
  scene.intended = [period](double time) {  // straight from sample to sample
    const double k = std::floor(time / period + 1e-6), from = path(k * period), to = path((k + 1) * period);
    const double slope = (to - from) / period;
    return motion_point{from + slope * (time - k * period), slope};
  };
  simulated_device whole(device, scene);
  led_device led(device, motion::translation);
  led.reset(path(0));
  any_estimator<double> estimator(device.velocity, period, device.encoder.step);
  actuator<double> drive(device, motion::translation);
  const transmission<double>& gear = drive.gear();
  estimator.reset(gear.joint_motion(path(0)));
  plain_law law, same_law;
  double most = 0;
  for (int k = 0; k < 2000; ++k) {
    device_sample sample;
    whole.read(sample);
    const plant_view before = whole.truth();
    const double estimate = gear.tool_motion(estimator.update(sample));
    const command<double> wanted = law.step(gear.tool_motion(sample.position), estimate);
    whole.write(drive.drive(wanted, estimate).demand());
    const plant_view after = whole.truth_from_now_on();
    const auto felt = [&](const plant_view& view) {
      return gear.tool_force(view.brake_damping * view.velocity - view.motor_torque);
    };
    led.sample(same_law, path(k * period), (path((k + 1) * period) - path(k * period)) / period);
    const double expected = (felt(before) + felt(after)) / 2;
    most = std::max(most, std::abs(expected));
    ASSERT_NEAR(led.estimate(), estimate, closeness * (1 + std::abs(estimate))) << k;
    ASSERT_NEAR(led.felt_force(), expected, closeness) << k;  // of forces about 1 N: times are sums of periods
  }
  EXPECT_GT(most, 0.2);
}

device_description punctual_arm() {
  device_description device = imperfect_arm();
  device.loop.jitter = 0;
  device.brake.tolerance = 0;
  return device;
}

TEST(LedDevice, IsTheSimulatedOneWithoutItsMechanics) {
  expect_like_the_simulated(plain_device());
  expect_like_the_simulated(punctual_arm());
}

TEST(LedDevice, AtEveryDelayAndLag) {
  for (const unsigned delay : {0u, 2u, 7u}) {
    device_description device = punctual_arm();
    device.loop.delay_samples = delay;
    device.loop.write_earliest = device.loop.write_latest = delay == 0 ? 0 : 0.3 * device.loop.sample_period;
    device.motor.amplifier_lag = delay == 2 ? 0 : 1e-3;
    device.brake.coil_lag = delay == 7 ? 0 : 3e-3;
    device.encoder.rounding = delay == 0 ? quantiser::round : quantiser::floor;
    expect_like_the_simulated(device);
  }
}

TEST(LedDevice, WithEveryEstimator) {
  for (const estimator_kind kind :
       {estimator_kind::least_squares, estimator_kind::butterworth, estimator_kind::inverse_time, estimator_kind::foaw,
        estimator_kind::kalman, estimator_kind::tracking_differentiator, estimator_kind::sensor,
        estimator_kind::interval_difference}) {
    SCOPED_TRACE(int(kind));
    device_description device = punctual_arm();
    device.velocity.estimator = kind;
    device.velocity.window = 8;
    device.velocity.order = 4;
    device.velocity.cutoff = 120;
    device.velocity.acceleration = 200;
    device.velocity.bandwidth = 300;
    // Edges are told in whole nanoseconds, and lie apart by some ten microseconds; the simulated sensor sees the
    // velocity change evenly over a step of integration, where it jumps at its end.
    const bool is_coarse = kind == estimator_kind::inverse_time || kind == estimator_kind::sensor;
    expect_like_the_simulated(device, is_coarse ? 3e-4 : 1e-6);
  }
}

}  // namespace
}  // namespace dashpot::simulated
