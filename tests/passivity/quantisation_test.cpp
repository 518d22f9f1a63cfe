// The gain from the encoder's error to the motor's force, measured at the law and the estimator themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <dashpot/estimators/any_estimator.hpp>

#include "certified_loop.hpp"
#include "law/evaluate.hpp"
#include "support/random_network.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

bool divides_by_the_interval(const CompiledCase& one) {
  return one.device.description.velocity.estimator == estimator_kind::interval_difference;
}

// Σ|h_j| over so many samples: positions that are 1, then 0, as soon after each other as the jitter allows where the
// estimate knows when.
double measured_gain(const CompiledCase& one, int samples) {
  const SampledLoop& loop = one.compilation->certificate.loop;
  any_estimator<double> estimator(loop.velocity, loop.sample_period, loop.joint_encoder_step);
  Evaluation<double> law(one.compilation->law);
  law.reset(0);
  estimator.reset(0);
  const double apart = loop.sample_period - (divides_by_the_interval(one) ? loop.jitter : 0);
  double sum = 0;
  for (int k = 0; k < samples; ++k) {
    device_sample sample;
    sample.position = k == 0 ? 1 : 0;
    sample.timestamp_ns = std::uint64_t(std::llround(1e9 * apart * (k + 1)));
    sum += std::abs(law.step(sample.position, estimator.update(sample)).force);
  }
  return sum;
}

// If this failed, the stated bound would be below what some error of the encoder does to the motor; or far above it,
// where the pulse has died away within the samples that are looked at.
TEST(QuantisationGain, IsThatOfTheLaw) {
  int compared = 0, died_away = 0;
  for (std::uint64_t seed = 1; compared < 60; ++seed) {
    SCOPED_TRACE(seed);
    const CompiledCase one = random_case(seed);
    if (!one.compilation || one.device.description.velocity.estimator == estimator_kind::foaw) continue;
    const double stated = one.compilation->certificate.quantisation_gain.value();
    const double measured = measured_gain(one, 6000);
    ++compared;
    // Its clock counts nanoseconds; and its part is stated beside that of the positions, which may make up for some of
    // it.
    const double off = divides_by_the_interval(one) ? 1e-9 / one.compilation->law.sample_period : 0;
    EXPECT_LE(measured, stated * (1 + 1e-9 + 2 * off));
    if (divides_by_the_interval(one)) continue;
    const auto& modes = one.compilation->form.linear.modes;
    const double slowest =
        modes.empty() ? 1 : to_double(modes.front().relaxation_rate) * one.compilation->law.sample_period;
    if (slowest * 6000 < 30) continue;
    ++died_away;
    EXPECT_GE(measured, stated * (1 - 1e-9));
  }
  EXPECT_GE(died_away, 10);
}

// Slips, and all of the force left to the motor.
std::optional<Compilation> held_case(std::uint64_t seed, SourceFile& source) {
  NetworkRecipe recipe;
  recipe.topology = seed % 4 == 0 ? Topology::tree : Topology::graph;
  recipe.most_nodes = 7;
  recipe.most_slips = 5;
  recipe.smallest_value = 1e-1;
  recipe.largest_value = 1e3;
  source = SourceFile("held.json", json_text(random_network(seed, recipe)));
  Choices choices;
  choices.decomposition = "virtual";
  choices.scheme = seed % 3 == 0 ? Scheme::backward_euler : Scheme::exact;
  Diagnostics diagnostics;
  return compile(source, choices, std::nullopt, diagnostics);
}

// If this failed, what is stated for slips would be below what an error of the encoder does while they hold, or above
// it once that has died away, in trees and in others.
TEST(QuantisationGain, OfSlipsIsThatOfAllThatHold) {
  int compared = 0, died_away = 0, networks = 0;
  for (std::uint64_t seed = 1; compared < 100; ++seed) {
    SCOPED_TRACE(seed);
    SourceFile source("", "");
    const std::optional<Compilation> one = held_case(seed, source);
    if (!one || !one->form.has_slips()) continue;
    ASSERT_TRUE(one->certificate.quantisation_gain);
    const double stated = *one->certificate.quantisation_gain, period = one->law.sample_period;
    Evaluation<double> law(one->law);
    law.reset(0);
    constexpr double pulse = 1e-9;  // [m]: no slip gives way
    double measured = std::abs(law.step(pulse, pulse / period).force) / pulse;
    double last = std::abs(law.step(0, -pulse / period).force) / pulse;
    measured += last;
    for (int k = 0; k < 20000; ++k) measured += last = std::abs(law.step(0, 0).force) / pulse;
    ++compared;
    networks += one->form.networks.empty() ? 0 : 1;
    EXPECT_LE(measured, stated * (1 + 1e-9));
    if (last > 1e-14 * stated) continue;
    ++died_away;
    EXPECT_GE(measured, stated * (1 - 1e-9));
  }
  EXPECT_GE(died_away, 20);
  EXPECT_GE(networks, 10);
}

}  // namespace
}  // namespace dashpot::testing
