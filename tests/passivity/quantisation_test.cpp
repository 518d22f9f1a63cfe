// The gain from the encoder's error to the motor's force, measured at the law and the estimator themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <dashpot/estimators/any_estimator.hpp>

#include "certified_loop.hpp"
#include "discretise/evaluate.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

// Σ|h_j| over so many samples: positions that are 1, then 0.
double measured_gain(const CompiledCase& one, int samples) {
  const SampledLoop& loop = one.compilation->certificate.loop;
  any_estimator<double> estimator(loop.velocity, loop.sample_period, loop.joint_encoder_step);
  Evaluation<double> law(one.compilation->law);
  law.reset(0);
  estimator.reset(0);
  double sum = 0;
  for (int k = 0; k < samples; ++k) {
    device_sample sample;
    sample.position = k == 0 ? 1 : 0;
    sum += std::abs(law.step(sample.position, estimator.update(sample)).force);
  }
  return sum;
}

// The stated bound would be below what some error of the encoder does to the motor; or far above it, where the pulse has
// died away within the samples that are looked at.
TEST(QuantisationGain, IsThatOfTheLaw) {
  int compared = 0, died_away = 0;
  for (std::uint64_t seed = 1; compared < 60; ++seed) {
    SCOPED_TRACE(seed);
    const CompiledCase one = random_case(seed);
    if (!one.compilation || one.device.description.velocity.estimator == estimator_kind::foaw) continue;
    const double stated = one.compilation->certificate.quantisation_gain.value();
    const double measured = measured_gain(one, 6000);
    ++compared;
    EXPECT_LE(measured, stated * (1 + 1e-9));
    const auto& modes = one.compilation->form.linear.modes;
    const double slowest = modes.empty() ? 1 : to_double(modes.front().relaxation_rate) * one.compilation->law.sample_period;
    if (slowest * 6000 < 30) continue;
    ++died_away;
    EXPECT_GE(measured, stated * (1 - 1e-9));
  }
  EXPECT_GE(died_away, 10);
}

}  // namespace
}  // namespace dashpot::testing
