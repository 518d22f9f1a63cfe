// What the simulated shaft's sensors show of a known motion.
#include <cmath>

#include <gtest/gtest.h>

#include "plain_device.hpp"

namespace dashpot::simulated {
namespace {

constexpr double step = 30e-6;

device_description coded_device(quantiser rounding) {
  device_description device = plain_device();
  device.encoder.step = step;
  device.encoder.rounding = rounding;
  return device;
}

scenario led_along(trajectory path) {
  scenario scene;
  scene.prescribed = true;
  scene.intended = std::move(path);
  return scene;
}

// If this failed, the encoder would round the wrong way, above all at negative positions, or give a finer position than
// its step.
TEST(Sensors, EncoderQuantisesAsDescribed) {
  simulated_device floored(coded_device(quantiser::floor), led_along(sine(0.001, 1.3)));
  simulated_device rounded(coded_device(quantiser::round), led_along(sine(0.001, 1.3)));
  device_sample sample;
  for (int k = 0; k < 1000; ++k) {
    floored.read(sample);
    const double truth = floored.truth().position;
    EXPECT_EQ(sample.counts, static_cast<std::int64_t>(std::floor(truth / step)));
    EXPECT_EQ(sample.position, static_cast<double>(sample.counts) * step);
    rounded.read(sample);
    EXPECT_LE(std::abs(sample.position - truth), step / 2 * (1 + 1e-9));
    EXPECT_EQ(sample.position, static_cast<double>(sample.counts) * step);
  }
}

// If this failed, an ideal encoder would quantise after all, or invent edges.
TEST(Sensors, IdealEncoderShowsTheTruth) {
  simulated_device device(plain_device(), led_along(sine(0.001, 1.3)));
  const device_sample sample = run(device, 78);
  EXPECT_EQ(sample.position, device.truth().position);
  EXPECT_NE(sample.position, 0);
  EXPECT_EQ(sample.edge_time_ns, 0u);
}

// If this failed, edge times would be those of the sampling, or of another edge: inverse-time estimators live on them.
TEST(Sensors, EdgesCarryTheInstantOfTheCrossing) {
  const double speed = 0.0123;
  simulated_device up(coded_device(quantiser::floor), led_along(through({{0, 1e-6}, {1, 1e-6 + speed}})));
  simulated_device down(coded_device(quantiser::round), led_along(through({{0, 1e-6}, {1, 1e-6 - speed}})));
  device_sample sample;
  for (int k = 0; k < 900; ++k) {
    up.read(sample);
    if (sample.counts > 0) {
      const double crossing = (static_cast<double>(sample.counts) * step - 1e-6) / speed;
      EXPECT_NEAR(static_cast<double>(sample.edge_time_ns), crossing * 1e9, 1);
    }
    down.read(sample);
    if (sample.counts < 0) {
      const double crossing = (1e-6 - (static_cast<double>(sample.counts) + 0.5) * step) / speed;
      EXPECT_NEAR(static_cast<double>(sample.edge_time_ns), crossing * 1e9, 1);
    }
  }
  EXPECT_GT(sample.edge_time_ns, 0u);
}

// If this failed, an edge that is crossed to and fro between two samples would not be noticed.
TEST(Sensors, EdgeIsSeenAtAReversalBetweenSamples) {
  // A peak 0.1 µm above the first edge, half-way between two samples; beyond the edge for 2 · 0.14 ms.
  const double curvature = 10;
  const auto peak = [=](double time) {
    const double from_peak = time - 0.00525;
    return motion_point{step + 0.1e-6 - curvature / 2 * from_peak * from_peak, -curvature * from_peak};
  };
  simulated_device device(coded_device(quantiser::floor), led_along(peak));
  const device_sample before = run(device, 6);
  const device_sample after = run(device, 1);
  EXPECT_EQ(before.counts, 0);
  EXPECT_EQ(after.counts, 0);
  const double way_up = 0.00525 - std::sqrt(2 * (step + 0.1e-6) / curvature);
  EXPECT_NEAR(static_cast<double>(before.edge_time_ns), way_up * 1e9, 1);
  const double crossing = 0.00525 + std::sqrt(2 * 0.1e-6 / curvature);
  EXPECT_NEAR(static_cast<double>(after.edge_time_ns), crossing * 1e9, 1);
}

// If this failed, a device without a velocity sensor would show a velocity that no encoder can know.
TEST(Sensors, VelocityIsShownOnlyWhereItIsSensed) {
  device_description description = plain_device();
  simulated_device without(description, led_along(through({{0, 0}, {1, 0.2}})));
  EXPECT_EQ(run(without, 10).velocity, 0);
  description.velocity.estimator = estimator_kind::sensor;
  simulated_device with(description, led_along(through({{0, 0}, {1, 0.2}})));
  EXPECT_EQ(run(with, 10).velocity, 0.2);
}

// If this failed, the sensor's bandwidth would be wrong by 2π, or acted on per sample instead of in time.
TEST(Sensors, VelocitySensorIsFirstOrder) {
  device_description description = plain_device();
  description.velocity.estimator = estimator_kind::sensor;
  description.velocity.bandwidth = 50;
  scenario scene;
  simulated_device device(description, scene);
  run(device, 6, {0.4, 0});
  // From rest under a constant acceleration a: v̂ = a (t − lag (1 − e^(−t/lag))).
  const double lag = 1 / (2 * 3.14159265358979323846 * 50), time = 0.005, acceleration = 2;
  device_sample sample = run(device, 1, {0.4, 0});
  const double expected = acceleration * (time + 0.001 - lag * (1 - std::exp(-(time + 0.001) / lag)));
  EXPECT_NEAR(sample.velocity, expected, 1e-14);
}

// If this failed, the sensor's noise would not have the stated rms, or not be centred.
TEST(Sensors, VelocityNoiseHasTheStatedRms) {
  device_description description = plain_device();
  description.velocity.estimator = estimator_kind::sensor;
  description.velocity.noise = 0.01;
  simulated_device device(description);
  const int samples = 20000;
  double sum = 0, squares = 0;
  device_sample sample;
  for (int k = 0; k < samples; ++k) {
    device.read(sample);
    sum += sample.velocity;
    squares += sample.velocity * sample.velocity;
  }
  // Five standard deviations of a mean and of a mean square of 20,000 normal draws.
  EXPECT_NEAR(sum / samples, 0, 5 * 0.01 / std::sqrt(samples));
  EXPECT_NEAR(squares / samples, 1e-4, 5 * 1e-4 * std::sqrt(2.0 / samples));
}

}  // namespace
}  // namespace dashpot::simulated
