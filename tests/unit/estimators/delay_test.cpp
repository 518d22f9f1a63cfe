// Declared delays against delays measured on slow motions, through the type the servo loop uses.

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <dashpot/estimators/any_estimator.hpp>

#include "motion.hpp"

namespace dashpot::delay_test {
namespace {

constexpr double sample_period = 1e-3;  // [s]
constexpr double step = 30e-6;          // what FOAW and the Kalman filter are tuned to [m]

struct tuned {
  const char* name;
  velocity_description description;
};

velocity_description described(estimator_kind kind, unsigned window = 1, unsigned order = 2, bool best_fit = false) {
  velocity_description wanted;
  wanted.estimator = kind;
  wanted.window = window;
  wanted.order = order;
  wanted.cutoff = 60;
  wanted.best_fit = best_fit;
  wanted.acceleration = 50;
  wanted.filter_factor = 5;
  return wanted;
}

const tuned position_estimators[] = {
    {"difference_1", described(estimator_kind::backward_difference, 1)},
    {"difference_15", described(estimator_kind::backward_difference, 15)},
    {"least_squares_1", described(estimator_kind::least_squares, 1)},
    {"least_squares_16", described(estimator_kind::least_squares, 16)},
    {"butterworth_2", described(estimator_kind::butterworth, 1, 2)},
    {"butterworth_4", described(estimator_kind::butterworth, 1, 4)},
    {"foaw_end", described(estimator_kind::foaw, 16)},
    {"foaw_best", described(estimator_kind::foaw, 16, 2, true)},
    {"kalman", described(estimator_kind::kalman)},
    {"super_twisting", described(estimator_kind::super_twisting)},
    {"tracking_differentiator", described(estimator_kind::tracking_differentiator)},
    {"interval_difference", described(estimator_kind::interval_difference)},
};

void PrintTo(const tuned& printed, std::ostream* out) { *out << printed.name; }

class Delay : public testing::TestWithParam<tuned> {
 protected:
  any_estimator<double> estimator{GetParam().description, sample_period, step};
};

// An estimator that declares another delay than it has would be judged wrongly by the certificate. On a velocity ramp
// the estimate is a (t − delay) exactly once the start is forgotten; positions up to 0.1 m rounded to 1e-17 m leave
// 1e-14/T/a = 1e-10 s.
TEST_P(Delay, OnASlowVelocityRamp) {
  const double acceleration = 0.1;  // [m/s²]
  sampled_motion samples(ramp(0, acceleration), 0, sample_period);
  estimator.reset(samples.next().position);
  double estimate = 0;
  while (samples.time() < 1) estimate = estimator.update(samples.next());
  EXPECT_NEAR((samples.velocity() - estimate) / acceleration, estimator.delay(), 1e-10);
}

// A delay that held for ramps only would shift a slow sine by another angle. The phase of a smooth filter is
// −ω delay (1 + O((ω delay)²)); with ω delay below 0.02 that is within 0.1 %.
TEST_P(Delay, OnASlowSine) {
  const double frequency = 0.2;  // [Hz]
  const double rate = 2 * pi * frequency;
  sampled_motion samples(sine(0, 0.05, frequency), 0, sample_period);
  estimator.reset(samples.next().position);
  while (samples.time() < 1 / frequency - sample_period / 2) estimator.update(samples.next());
  double in_phase = 0, in_quadrature = 0;
  while (samples.time() < 2 / frequency - sample_period / 2) {
    const double estimate = estimator.update(samples.next());
    in_phase += estimate * std::sin(rate * samples.time());
    in_quadrature += estimate * std::cos(rate * samples.time());
  }
  EXPECT_NEAR(std::atan2(-in_quadrature, in_phase) / rate, estimator.delay(), 1e-3 * estimator.delay());
}

INSTANTIATE_TEST_SUITE_P(All, Delay, testing::ValuesIn(position_estimators),
                         [](const auto& instance) { return std::string(instance.param.name); });

double mean_delay_on_ramp(double start, double acceleration, double period) {
  sampled_motion samples(ramp(start, acceleration), step, period);
  inverse_time<double> estimator(step, period);
  double sum = 0;
  int count = 0;
  while (samples.time() < 1) {
    const device_sample sample = samples.next();
    const double estimate = estimator.update(sample.position, sample.edge_time_ns, sample.timestamp_ns);
    if (samples.time() < 0.1) continue;
    sum += (samples.velocity() - estimate) / acceleration;
    ++count;
  }
  return sum / count;
}

// Inverse time is late by the spacing of the edges, which the declared figure must follow from slow to fast. The speed
// changes by 1 % over the run, and so does the delay.
TEST(InverseTimeDelay, IsTheEdgeSpacing) {
  const inverse_time<double> estimator(step, sample_period);
  for (const double counts_per_sample : {0.08, 0.31, 2.7, 9.3}) {
    const double speed = counts_per_sample * step / sample_period;
    EXPECT_NEAR(mean_delay_on_ramp(speed, 0.01 * speed, sample_period), estimator.delay_at(speed),
                0.02 * estimator.delay_at(speed))
        << counts_per_sample << " counts a sample";
  }
  EXPECT_EQ(estimator.delay(), estimator.delay_at(step / sample_period));
}

// The tracking differentiator falls behind with speed outside its linear zone; `delay_at` says by how much for a steady
// speed. An acceleration a changes that by a/R relative, here a thousandth.
TEST(TrackingDifferentiatorDelay, GrowsBeyondTheLinearZone) {
  tracking_differentiator<double> estimator(10, 5, sample_period);  // the zone ends at 0.05 m/s
  const double acceleration = 0.01;                                 // [m/s²]
  sampled_motion samples(ramp(0.39, acceleration), 0, sample_period);
  double estimate = 0;
  while (samples.time() < 1) estimate = estimator.update(samples.next().position);
  EXPECT_NEAR((samples.velocity() - estimate) / acceleration, estimator.delay_at(0.4), 3e-3 * estimator.delay_at(0.4));
  EXPECT_GT(estimator.delay_at(0.4), 4 * estimator.delay());
}

// A sensor is as late as its own first-order lag, and an unlimited one not at all.
TEST(SensorDelay, IsItsTimeConstant) {
  EXPECT_DOUBLE_EQ(sensor<double>(50, sample_period).delay(), 1 / (2 * pi * 50));
  EXPECT_EQ(sensor<double>(0, sample_period).delay(), 0);
}

}  // namespace
}  // namespace dashpot::delay_test
