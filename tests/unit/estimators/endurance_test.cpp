// Every estimator, in both precisions, through a long random walk, reversals and a standstill far from zero.

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <dashpot/estimators/any_estimator.hpp>

#include "motion.hpp"

namespace dashpot::endurance_test {
namespace {

constexpr double sample_period = 1e-3;            // [s]
constexpr double step = 30e-6;                    // [m]
constexpr double quantum = step / sample_period;  // one count a sample [m/s]

velocity_description tuned(estimator_kind kind) {
  velocity_description wanted;
  wanted.estimator = kind;
  wanted.window = 15;
  wanted.order = 4;
  wanted.cutoff = 120;
  wanted.acceleration = 20;
  wanted.filter_factor = 5;
  return wanted;
}

velocity_description best_fit() {
  velocity_description wanted = tuned(estimator_kind::foaw);
  wanted.best_fit = true;
  return wanted;
}

struct named {
  std::string name;
  velocity_description description;
};

std::vector<named> all_of_them() {
  std::vector<named> all;
  for (const estimator_kind kind : all_estimators) all.push_back({name_of(kind), tuned(kind)});
  all.push_back({"foaw_best_fit", best_fit()});
  return all;
}

void PrintTo(const named& printed, std::ostream* out) { *out << printed.name; }

std::string name_of_instance(const testing::TestParamInfo<named>& instance) { return instance.param.name; }

class Endurance : public testing::TestWithParam<named> {};

// One count up, down or none a sample, edges in the middle between samples, starting far from zero.
template <class Scalar>
double largest_on_random_walk(any_estimator<Scalar> estimator, int length) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> move(-1, 1);
  device_sample sample;
  std::int64_t counts = 20000;
  sample.edge_time_ns = 1;
  estimator.reset(static_cast<Scalar>(step * static_cast<double>(counts)));
  double largest = 0;
  for (int k = 1; k <= length; ++k) {
    const int moved = move(random);
    counts += moved;
    sample.position = step * static_cast<double>(counts);
    sample.velocity = moved * quantum;
    sample.timestamp_ns = static_cast<std::uint64_t>(k) * 1'000'000;
    if (moved != 0) sample.edge_time_ns = sample.timestamp_ns - 500'000;
    const double estimate = static_cast<double>(estimator.update(sample));
    if (!std::isfinite(estimate)) return estimate;
    largest = std::max(largest, std::abs(estimate));
  }
  return largest;
}

// An estimator that drifts, overflows or sticks would, in a million samples, leave the walk's own largest velocity of
// one count a sample. Averages cannot exceed it; filters overshoot it by less than half.
TEST_P(Endurance, StaysBoundedOnARandomWalk) {
  const auto& wanted = GetParam().description;
  EXPECT_LE(largest_on_random_walk(any_estimator<double>(wanted, sample_period, step), 1'000'000), 1.5 * quantum);
  EXPECT_LE(largest_on_random_walk(any_estimator<float>(wanted, sample_period, step), 1'000'000), 1.5 * quantum);
}

// Forth and back at 0.05 m/s, a quarter of a second each way, about 0.5 m.
test_motion triangle() {
  return {[](double t) {
            const double phase = std::fmod(t + 100, 0.5);
            return 0.5 + 0.05 * (phase < 0.25 ? phase : 0.5 - phase);
          },
          [](double t) { return std::fmod(t + 100, 0.5) < 0.25 ? 0.05 : -0.05; }};
}

// The mean estimate over the last fifth of each stretch, relative to the velocity there; the least of ten stretches.
template <class Scalar>
double least_recovery(any_estimator<Scalar> estimator) {
  sampled_motion samples(triangle(), step, sample_period);
  estimator.reset(static_cast<Scalar>(samples.next().position));
  double least = 2;
  for (int stretch = 0; stretch < 10; ++stretch) {
    double sum = 0;
    for (int k = 1; k < 250; ++k) {
      const double estimate = static_cast<double>(estimator.update(samples.next()));
      if (k >= 200) sum += estimate / samples.velocity() / 50;
    }
    samples.next();
    least = std::min(least, sum);
  }
  return least;
}

// After a reversal the estimate must come round, to the right sign and size: 200 samples are many times any memory
// here, and 50 samples of 1.67 counts average the quantisation to under 2 %.
TEST_P(Endurance, ComesRoundAfterAReversal) {
  const auto& wanted = GetParam().description;
  EXPECT_NEAR(least_recovery(any_estimator<double>(wanted, sample_period, step)), 1, 0.02);
  EXPECT_NEAR(least_recovery(any_estimator<float>(wanted, sample_period, step)), 1, 0.02);
}

test_motion halt() {
  return {[](double t) { return 0.5 + 0.05 * std::min(t, 0.3); }, [](double t) { return t < 0.3 ? 0.05 : 0.0; }};
}

template <class Scalar>
double left_a_second_after_halt(any_estimator<Scalar> estimator) {
  sampled_motion samples(halt(), step, sample_period);
  estimator.reset(static_cast<Scalar>(samples.next().position));
  while (samples.time() < 0.3 + 1) estimator.update(samples.next());
  return static_cast<double>(estimator.update(samples.next()));
}

// A velocity that remains at rest is a force that creeps. All estimators reach exactly 0 (and no subnormal number,
// which would make every later step slow), except inverse time, which only knows that no edge came for a second.
TEST_P(Endurance, ReturnsToZeroAtRest) {
  const auto& wanted = GetParam().description;
  const double bound = wanted.estimator == estimator_kind::inverse_time ? step : 0;
  EXPECT_LE(std::abs(left_a_second_after_halt(any_estimator<double>(wanted, sample_period, step))), bound);
  EXPECT_LE(std::abs(left_a_second_after_halt(any_estimator<float>(wanted, sample_period, step))), bound);
}

// Reset means at rest here: the first sample at the same place must not look like a motion from somewhere else.
TEST_P(Endurance, IsAtRestAfterReset) {
  any_estimator<double> estimator(GetParam().description, sample_period, step);
  sampled_motion samples(ramp(0.3, 0), step, sample_period);
  while (samples.time() < 0.1) estimator.update(samples.next());
  estimator.reset(0.25);
  device_sample at_rest;
  at_rest.position = 0.25;
  at_rest.edge_time_ns = 1;
  for (int k = 0; k < 3; ++k) {
    at_rest.timestamp_ns += 1'000'000;
    EXPECT_EQ(estimator.update(at_rest), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Endurance, testing::ValuesIn(all_of_them()), name_of_instance);

}  // namespace
}  // namespace dashpot::endurance_test
