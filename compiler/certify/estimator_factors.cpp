#include "certify/estimator_factors.hpp"

#include <algorithm>
#include <cmath>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/estimators/estimator_names.hpp>

namespace dashpot::compiler {
namespace {

using Complex = std::complex<double>;

// The numerator of E over (1 − w)/T: partial sums.
EstimatorFactors moving_average(const any_estimator<double>& estimator, double sample_period) {
  const auto transfer = estimator.transfer();
  EstimatorFactors factors{{}, {}};
  double sum = 0;
  for (unsigned i = 0; i < transfer.numerator_order; ++i)
    factors.taps.push_back(sample_period * (sum += transfer.numerator[i]));
  return factors;
}

// Each section g² (1 + w)²/(δ² + g k δ (2 − δ) + g² (2 − δ)²), δ = 1 − w, has the poles s = e^{±jφ} of s² + k s + 1:
// p = (1 + g s)/(1 − g s), 1 − p = −2 g s/(1 − g s).
EstimatorFactors butterworth(const velocity_description& velocity, double sample_period) {
  const unsigned order = velocity.order < 4 ? 2 : 4;
  const double g = tangent_of_half_turns(velocity.cutoff * sample_period);
  EstimatorFactors factors;
  for (unsigned i = 0; i < order / 2; ++i) {
    const double half_turns = (order - 1 - 2.0 * i) / (2.0 * order);
    const double k = 2 * sine_of_half_turns(half_turns);
    const double gain = g * g / (1 + g * (k + g));
    std::vector<double> taps(factors.taps.size() + 2, 0.0);
    for (std::size_t t = 0; t < factors.taps.size(); ++t) {
      taps[t] += gain * factors.taps[t];
      taps[t + 1] += 2 * gain * factors.taps[t];
      taps[t + 2] += gain * factors.taps[t];
    }
    factors.taps = taps;
    const Complex s(-k / 2, sine_of_half_turns(0.5 - half_turns));
    for (const Complex root : {s, std::conj(s)})
      factors.poles.push_back({(1.0 + g * root) / (1.0 - g * root), -2.0 * g * root / (1.0 - g * root)});
  }
  return factors;
}

// β/(1 + (1 + r² − 4r) w + r² w²): 1 − p = (1 − r)/2 · ((3 − r) ± √(1 + r² − 6r))
EstimatorFactors steady_kalman(const any_estimator<double>& estimator, double sample_period) {
  const auto transfer = estimator.transfer();
  const double beta = transfer.numerator[0] * sample_period;
  const double one_minus_r = std::sqrt(beta / 2), r = 1 - one_minus_r;
  const Complex root = std::sqrt(Complex(1 + r * r - 6 * r, 0));
  EstimatorFactors factors{{beta}, {}};
  for (const double sign : {1.0, -1.0}) {
    const Complex loss = one_minus_r / 2 * (3 - r + sign * root);
    factors.poles.push_back({1.0 - loss, loss});
  }
  return factors;
}

}  // namespace

std::optional<EstimatorFactors> estimator_factors(const SampledLoop& loop) {
  if (!loop.has_device) return EstimatorFactors{};
  const any_estimator<double> estimator(loop.velocity, loop.sample_period, loop.joint_encoder_step);
  switch (loop.velocity.estimator) {
    case estimator_kind::backward_difference:
    case estimator_kind::least_squares: return moving_average(estimator, loop.sample_period);
    case estimator_kind::butterworth: return butterworth(loop.velocity, loop.sample_period);
    case estimator_kind::kalman: return steady_kalman(estimator, loop.sample_period);
    default: return std::nullopt;
  }
}

std::optional<double> adaptive_window_gain(const SampledLoop& loop) {
  if (!loop.has_device || loop.velocity.estimator != estimator_kind::foaw) return std::nullopt;
  const unsigned longest = std::min(std::max(loop.velocity.window, 1u), longest_window);
  double square = 0;
  for (unsigned age = 0; age < longest; ++age) {
    double largest = 0;
    for (unsigned n = age + 1; n <= longest; ++n) {
      const double count = n, j = age;
      const double best_fit = 6 * (j + 1) * (count - j) / (count * (count + 1) * (count + 2));
      largest = std::max(largest, loop.velocity.best_fit ? best_fit : 1 / count);
    }
    square += largest;
  }
  return std::sqrt(square) * (1 + 1e-12);
}

std::optional<double> estimate_gain(const SampledLoop& loop) {
  if (loop.has_device && loop.velocity.estimator == estimator_kind::butterworth) return 1;
  const std::optional<EstimatorFactors> factors = estimator_factors(loop);
  if (!factors) return adaptive_window_gain(loop);
  double gain = 0;
  for (const double tap : factors->taps) gain += std::abs(tap);
  // 1/(1 − |p|) = (1 + |p|)/(1 − |p|²), and 1 − |p|² = 2 Re(1 − p) − |1 − p|²
  for (const EstimatorPole& pole : factors->poles)
    gain *= (1 + std::abs(pole.pole)) / (2 * pole.loss.real() - std::norm(pole.loss));
  return gain * (1 + 1e-12);
}

}  // namespace dashpot::compiler
