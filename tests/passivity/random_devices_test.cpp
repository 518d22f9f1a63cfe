// The bound over all frequencies on compiled laws and devices, against a scan of the frequencies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "certified_loop.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

int cases() { return std::getenv("DASHPOT_LONG") != nullptr ? 5000 : 200; }

// S at single angles: a logarithmic grid, every relaxation rate, and a search around the largest.
double scanned(const NeededDamping& needed, const std::vector<double>& rates, double sample_period) {
  const auto at = [&](double angle) {
    const double x = std::tan(angle / 4);
    return needed.on({x, x}).at_centre;
  };
  constexpr double pi = 3.14159265358979323846;
  std::vector<double> angles = {0, pi};
  for (int i = 0; i <= 600; ++i) angles.push_back(pi * std::pow(10, -9.0 * i / 600));
  for (const double rate : rates) angles.push_back(std::min(pi, rate * sample_period));
  double best = 0, largest = at(0);
  for (const double angle : angles)
    if (const double here = at(angle); here > largest) largest = here, best = angle;
  for (double step = std::max(best / 20, 1e-9); step > 1e-12; step *= 0.8)
    for (const double angle : {std::max(best - step, 0.0), std::min(best + step, pi)})
      if (const double here = at(angle); here > largest) largest = here, best = angle;
  return largest;
}

// The certificate would promise too little on a device with delay, lag and filter, or ask for too much.
TEST(RandomDevices, TheBoundMeetsAScan) {
  int compared = 0;
  for (std::uint64_t seed = 1; compared < cases(); ++seed) {
    SCOPED_TRACE(seed);
    const CompiledCase one = random_case(seed);
    if (!one.compilation) continue;
    const std::optional<MotorConstants> motor = motor_constants(one.compilation->law);
    const SampledLoop& loop = one.compilation->certificate.loop;
    const std::optional<EstimatorFactors> estimator = estimator_factors(loop);
    if (!motor || (motor->follows_estimate() && !estimator)) continue;
    ++compared;
    const EstimatorFactors factors = estimator.value_or(EstimatorFactors{});
    const NeededDamping needed(*motor, loop, factors);
    const SampledBound bound = sampled_bound(needed, loop.sample_period);
    std::vector<double> rates;
    for (const Mode& mode : one.compilation->form.linear.modes) rates.push_back(to_double(mode.relaxation_rate));
    const double largest = scanned(needed, rates, loop.sample_period);
    const double rounding = 1e-11 * needed.scale();
    EXPECT_GE(bound.needed, largest - rounding);
    EXPECT_LE(bound.needed, std::max(largest, 0.0) * (1 + 1e-6) + rounding);
  }
}

}  // namespace
}  // namespace dashpot::testing
