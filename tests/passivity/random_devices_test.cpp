// The bound over all frequencies on compiled laws and devices, against a scan of the frequencies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "certified_loop.hpp"
#include "support/repetitions.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

int compared_devices() { return static_cast<int>(repetitions(120, 5000)); }

constexpr double pi = 3.14159265358979323846;

// A logarithmic grid for slow modes, a linear one for what delays and windows make ripple near Nyquist, and every rate.
std::vector<double> grid(const std::vector<double>& rates, double sample_period) {
  std::vector<double> angles = {0};
  for (int i = 0; i <= 600; ++i) angles.push_back(pi * std::pow(10, -9.0 * i / 600));
  for (int i = 1; i <= 200; ++i) angles.push_back(pi * i / 200);
  for (const double rate : rates) angles.push_back(std::min(pi, rate * sample_period));
  std::sort(angles.begin(), angles.end());
  return angles;
}

// S at single angles, and the top of every hill of the grid: the highest point of the grid may lie on a lower hill.
double scanned(const NeededDamping& needed, const std::vector<double>& rates, double sample_period) {
  const auto at = [&](double angle) {
    const double x = std::tan(angle / 4);
    return needed.on({x, x}).at_centre;
  };
  const std::vector<double> angles = grid(rates, sample_period);
  std::vector<double> heights;
  for (const double angle : angles) heights.push_back(at(angle));
  double largest = *std::max_element(heights.begin(), heights.end());
  for (std::size_t i = 1; i + 1 < angles.size(); ++i) {
    if (heights[i] < heights[i - 1] || heights[i] < heights[i + 1]) continue;
    double low = angles[i - 1], high = angles[i + 1];
    for (int step = 0; step < 60; ++step) {
      const double left = low + (high - low) / 3, right = high - (high - low) / 3;
      const double at_left = at(left), at_right = at(right);
      largest = std::max({largest, at_left, at_right});
      (at_left < at_right ? low : high) = at_left < at_right ? left : right;
    }
  }
  return largest;
}

// If this failed, the certificate would promise too little on a device with delay, lag and filter, or ask for too much.
TEST(RandomDevices, TheBoundMeetsAScan) {
  int compared = 0;
  for (std::uint64_t seed = 1; compared < compared_devices(); ++seed) {
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
