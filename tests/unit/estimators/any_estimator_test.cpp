// The one type behind which all estimators stand, their names and the faults of their descriptions.

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

#include <dashpot/estimators/any_estimator.hpp>

namespace dashpot {
namespace {

constexpr double sample_period = 1e-3;  // [s]
constexpr double step = 30e-6;          // [m]

constexpr velocity_description tuned(estimator_kind kind) {
  velocity_description wanted;
  wanted.estimator = kind;
  wanted.window = 12;
  wanted.order = 4;
  wanted.cutoff = 90;
  wanted.acceleration = 3;
  wanted.filter_factor = 4;
  wanted.bandwidth = 200;
  return wanted;
}

constexpr any_estimator<double> any(estimator_kind kind) {
  return any_estimator<double>(tuned(kind), sample_period, step);
}

device_sample next_sample(std::mt19937& random, const device_sample& before) {
  std::uniform_int_distribution<int> move(-2, 3);
  device_sample sample = before;
  const int moved = move(random);
  sample.position += moved * step;
  sample.velocity = moved * step / sample_period;
  sample.timestamp_ns += 1'000'000 + std::uniform_int_distribution<int>(-200'000, 200'000)(random);
  if (moved != 0) sample.edge_time_ns = sample.timestamp_ns - 300'000;
  return sample;
}

// Feeds both the same samples and expects the same bits.
template <class Direct, class Input>
void expect_same(estimator_kind kind, Direct direct, Input input) {
  any_estimator<double> wrapped = any(kind);
  EXPECT_EQ(wrapped.kind(), kind);
  EXPECT_EQ(wrapped.delay(), direct.delay());
  std::mt19937 random(5);
  device_sample sample;
  sample.position = 0.1;
  wrapped.reset(sample.position);
  direct.reset(sample.position);
  for (int k = 0; k < 200; ++k) {
    sample = next_sample(random, sample);
    ASSERT_EQ(wrapped.update(sample), input(direct, sample)) << name_of(kind) << ", sample " << k;
  }
}

constexpr auto from_position = [](auto& estimator, const device_sample& sample) {
  return estimator.update(sample.position);
};

// A description that reached the wrong estimator, or the right one with a neighbour's number, would run unnoticed.
TEST(AnyEstimator, IsTheEstimatorDescribed) {
  expect_same(estimator_kind::backward_difference, backward_difference<double>(12, sample_period), from_position);
  expect_same(estimator_kind::least_squares, least_squares<double>(12, sample_period), from_position);
  expect_same(estimator_kind::butterworth, low_pass<double>(4, 90, sample_period), from_position);
  expect_same(estimator_kind::foaw, foaw<double>(12, foaw_fit::end, step, sample_period), from_position);
  expect_same(estimator_kind::kalman, kalman<double>(3, step, sample_period), from_position);
  expect_same(estimator_kind::super_twisting, super_twisting<double>(3, sample_period), from_position);
  expect_same(estimator_kind::tracking_differentiator, tracking_differentiator<double>(3, 4, sample_period),
              from_position);
  expect_same(estimator_kind::inverse_time, inverse_time<double>(step, sample_period),
              [](auto& estimator, const device_sample& sample) {
                return estimator.update(sample.position, sample.edge_time_ns, sample.timestamp_ns);
              });
  expect_same(estimator_kind::sensor, sensor<double>(200, sample_period),
              [](auto& estimator, const device_sample& sample) { return estimator.update(sample.velocity); });
  expect_same(estimator_kind::interval_difference, interval_difference<double>(sample_period),
              [](auto& estimator, const device_sample& sample) {
                return estimator.update(sample.position, sample.timestamp_ns);
              });
}

// `best_fit` is a choice between two estimators; ignored, one would never run.
TEST(AnyEstimator, BuildsTheFitAskedFor) {
  velocity_description wanted = tuned(estimator_kind::foaw);
  wanted.best_fit = true;
  any_estimator<double> wrapped(wanted, sample_period, step);
  foaw<double> direct(12, foaw_fit::best, step, sample_period);
  std::mt19937 random(6);
  device_sample sample;
  for (int k = 0; k < 200; ++k) {
    sample = next_sample(random, sample);
    ASSERT_EQ(wrapped.update(sample), direct.update(sample.position));
  }
}

template <class Direct>
void expect_same_transfer(estimator_kind kind, const Direct& direct) {
  const auto wrapped = any(kind).transfer();
  const auto wide = widen<longest_window>(direct.transfer());
  EXPECT_EQ(any(kind).max_gain(), direct.max_gain());
  EXPECT_EQ(wrapped.numerator_order, wide.numerator_order);
  EXPECT_EQ(wrapped.denominator_order, wide.denominator_order);
  for (unsigned i = 0; i <= longest_window; ++i) {
    EXPECT_EQ(wrapped.numerator[i], wide.numerator[i]);
    EXPECT_EQ(wrapped.denominator[i], wide.denominator[i]);
  }
}

// The certificate reads the transfer function here; it must be that of the estimator that runs.
TEST(AnyEstimator, HasTheTransferFunctionOfWhatItHolds) {
  expect_same_transfer(estimator_kind::backward_difference, backward_difference<double>(12, sample_period));
  expect_same_transfer(estimator_kind::least_squares, least_squares<double>(12, sample_period));
  expect_same_transfer(estimator_kind::butterworth, low_pass<double>(4, 90, sample_period));
  expect_same_transfer(estimator_kind::kalman, kalman<double>(3, step, sample_period));
  expect_same_transfer(estimator_kind::sensor, sensor<double>(200, sample_period));
  expect_same_transfer(estimator_kind::interval_difference, interval_difference<double>(sample_period));
}

// A gain or a transfer function for a nonlinear estimator would be an invention; a linear one without would be refused.
TEST(AnyEstimator, OnlyLinearOnesHaveATransferFunction) {
  for (const estimator_kind kind : all_estimators) {
    EXPECT_EQ(any(kind).transfer().numerator[0] != 0, is_linear(kind)) << name_of(kind);
    EXPECT_EQ(any(kind).max_gain() != 0, is_linear(kind)) << name_of(kind);
  }
}

// A brake is held for as long as the estimate remembers; a memory declared too short would release it early.
TEST(AnyEstimator, DeclaresTheMemoryOfFiniteEstimators) {
  for (const estimator_kind kind : all_estimators) {
    const bool is_finite = kind == estimator_kind::backward_difference || kind == estimator_kind::least_squares ||
                           kind == estimator_kind::foaw;
    const unsigned memory = kind == estimator_kind::interval_difference ? 1U : is_finite ? 12U : 0U;
    EXPECT_EQ(any(kind).memory(), memory) << name_of(kind);
  }
}

// The loop copies it, and firmware places it in initialised memory.
static_assert(std::is_trivially_copyable_v<any_estimator<float>>);
constexpr any_estimator<float> designed_by_the_compiler(tuned(estimator_kind::kalman), sample_period, step);
static_assert(designed_by_the_compiler.delay() > 0);

// A name that does not lead back to its kind would make a device file mean something else.
TEST(EstimatorNames, LeadBackToTheirKinds) {
  EXPECT_EQ(std::size(all_estimators), 10U);
  for (const estimator_kind kind : all_estimators) {
    ASSERT_NE(estimator_from_name(name_of(kind)), nullptr) << name_of(kind);
    EXPECT_EQ(*estimator_from_name(name_of(kind)), kind);
  }
}

// The names are part of the device file format.
TEST(EstimatorNames, AreThoseOfTheFormat) {
  for (const char* name : {"backward_difference", "least_squares", "butterworth", "inverse_time", "foaw", "kalman",
                           "super_twisting", "tracking_differentiator", "sensor", "interval_difference"})
    EXPECT_NE(estimator_from_name(name), nullptr) << name;
  for (const char* name : {"", "foa", "foaw ", "Foaw", "low_pass"})
    EXPECT_EQ(estimator_from_name(name), nullptr) << name;
}

struct faulty {
  estimator_kind kind;
  void (*spoil)(velocity_description&);
  estimator_fault expected;
};

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const faulty faulty_descriptions[] = {
    {estimator_kind::backward_difference, [](auto& d) { d.window = 0; }, estimator_fault::window},
    {estimator_kind::backward_difference, [](auto& d) { d.window = longest_window + 1; }, estimator_fault::window},
    {estimator_kind::least_squares, [](auto& d) { d.window = 0; }, estimator_fault::window},
    {estimator_kind::foaw, [](auto& d) { d.window = 0; }, estimator_fault::window},
    {estimator_kind::butterworth, [](auto& d) { d.order = 3; }, estimator_fault::order},
    {estimator_kind::butterworth, [](auto& d) { d.cutoff = 0; }, estimator_fault::cutoff},
    {estimator_kind::butterworth, [](auto& d) { d.cutoff = 500; }, estimator_fault::cutoff},
    {estimator_kind::butterworth, [](auto& d) { d.cutoff = nan; }, estimator_fault::cutoff},
    {estimator_kind::kalman, [](auto& d) { d.acceleration = 0; }, estimator_fault::acceleration},
    {estimator_kind::super_twisting, [](auto& d) { d.acceleration = -1; }, estimator_fault::acceleration},
    {estimator_kind::tracking_differentiator, [](auto& d) { d.acceleration = nan; }, estimator_fault::acceleration},
    {estimator_kind::tracking_differentiator, [](auto& d) { d.filter_factor = 0.5; }, estimator_fault::filter_factor},
    {estimator_kind::sensor, [](auto& d) { d.bandwidth = -1; }, estimator_fault::bandwidth},
};

// A description that cannot be built must be refused, with the key to blame, before it is built all the same.
TEST(EstimatorFault, NamesTheKeyToBlame) {
  for (const faulty& each : faulty_descriptions) {
    velocity_description wanted = tuned(each.kind);
    EXPECT_EQ(fault_in(wanted, sample_period, step), estimator_fault::none) << name_of(each.kind);
    each.spoil(wanted);
    EXPECT_EQ(fault_in(wanted, sample_period, step), each.expected) << name_of(each.kind);
  }
}

// Three estimators are tuned to the encoder's quantum and mean nothing without one; the others do.
TEST(EstimatorFault, AsksForAnEncoderStepWhereItMatters) {
  for (const estimator_kind kind : all_estimators) {
    const bool needs_step =
        kind == estimator_kind::inverse_time || kind == estimator_kind::foaw || kind == estimator_kind::kalman;
    EXPECT_EQ(fault_in(tuned(kind), sample_period, 0),
              needs_step ? estimator_fault::encoder_step : estimator_fault::none)
        << name_of(kind);
  }
}

}  // namespace
}  // namespace dashpot
