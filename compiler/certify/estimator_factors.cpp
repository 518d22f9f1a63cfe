#include "certify/estimator_factors.hpp"

#include <algorithm>
#include <cmath>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/estimators/estimator_names.hpp>
#include <dashpot/estimators/kalman.hpp>

#include "certify/adaptive_window.hpp"
#include "linear/real.hpp"

namespace dashpot::compiler {
namespace {

using Complex = std::complex<double>;

// The numerator of E divided by (1 − w)/T: partial sums.
EstimatorFactors moving_average(const any_estimator<double>& estimator, double sample_period) {
  const auto transfer = estimator.transfer();
  EstimatorFactors factors{{}, {}};
  double sum = 0;
  for (unsigned i = 0; i < transfer.numerator_order; ++i)
    factors.taps.push_back(sample_period * (sum += transfer.numerator[i]));
  return factors;
}

// Each section g² (1 + w)²/(δ² + g k δ (2 − δ) + g² (2 − δ)²), δ = 1 − w, has the poles s = e^{±jφ} of s² + k s + 1:
// p = (1 + g s)/(1 − g s), 1 − p = −2 g s/(1 − g s), 1 + p = 2/(1 − g s), and is Π g/(1 − g s) · (1 + w)/(1 − p w).
EstimatorFactors butterworth(const velocity_description& velocity, double sample_period) {
  const unsigned order = velocity.order < 4 ? 2 : 4;
  const double g = tangent_of_half_turns(velocity.cutoff * sample_period);
  EstimatorFactors factors;
  for (unsigned i = 0; i < order / 2; ++i) {
    const double half_turns = (order - 1 - 2.0 * i) / (2.0 * order);
    const double k = 2 * sine_of_half_turns(half_turns);
    const Complex s(-k / 2, sine_of_half_turns(0.5 - half_turns));
    for (const Complex root : {s, std::conj(s)}) {
      const Complex inverse = 1.0 / (1.0 - g * root);
      factors.poles.push_back({(1.0 + g * root) * inverse, -2.0 * g * root * inverse, 2.0 * inverse, g * inverse});
    }
  }
  return factors;
}

Complex rounded(const Real& real, const Real& imaginary) { return {to_double(real), to_double(imaginary)}; }

// The recursion of the runtime as it is rounded, with ρ = 1 − α and b = (β/T) T of its numbers:
// b/(1 − (1 + ρ − b) w + ρ w²). (1 − p)(1 − p′) = b and (1 + p)(1 + p′) = 2 (1 + ρ) − b.
std::optional<EstimatorFactors> steady_kalman(const velocity_description& velocity, double sample_period, double step) {
  const kalman<double> filter(velocity.acceleration, step, sample_period);
  const Real rho = filter.leak(), b = Real(filter.beta() / sample_period) * Real(sample_period);
  const Real at_nyquist = 2 * (1 + rho) - b;
  if (!(b > 0 && at_nyquist > 0 && rho < 1)) return std::nullopt;
  const Real half_sum = (1 + rho - b) / 2, square = half_sum * half_sum - rho;
  EstimatorFactors factors{{to_double(b)}, {}};
  if (square < 0) {
    const Real imaginary = sqrt(Real(-square));
    for (const int sign : {1, -1})
      factors.poles.push_back({rounded(half_sum, sign * imaginary), rounded(1 - half_sum, -sign * imaginary),
                               rounded(1 + half_sum, sign * imaginary), 0});
    return factors;
  }
  // The larger pole first; the other one from their product.
  const Real larger = half_sum + (half_sum < 0 ? -sqrt(square) : sqrt(square)), other = larger == 0 ? 0 : rho / larger;
  for (const Real& pole : {larger, other})
    factors.poles.push_back({rounded(pole, 0), rounded(1 - pole, 0), rounded(1 + pole, 0), 0});
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
    case estimator_kind::kalman: return steady_kalman(loop.velocity, loop.sample_period, loop.joint_encoder_step);
    case estimator_kind::interval_difference: return EstimatorFactors{};
    default: return std::nullopt;
  }
}

bool divides_by_varying_interval(const SampledLoop& loop) {
  return loop.has_device && loop.velocity.estimator == estimator_kind::interval_difference && loop.jitter > 0;
}

std::optional<double> estimate_gain(const SampledLoop& loop) {
  if (loop.has_device && loop.velocity.estimator == estimator_kind::butterworth) return 1;
  if (divides_by_varying_interval(loop)) {
    const double shortest = loop.sample_period - loop.jitter;
    return shortest > 0 ? std::optional(loop.sample_period / shortest * (1 + 1e-12)) : std::nullopt;
  }
  const std::optional<EstimatorFactors> factors = estimator_factors(loop);
  if (!factors) return adaptive_window_gain(loop);
  double gain = 0;
  for (const double tap : factors->taps) gain += std::abs(tap);
  for (const EstimatorPole& pole : factors->poles)  // 1/(1 − |p|) = (1 + |p|)/(1 − |p|²)
    gain *= (1 + std::abs(pole.pole)) / pole.norm_loss();
  return gain * (1 + 1e-12);
}

// Its answer to one difference, until the slowest pole has gone by 1e-15 and all four together by less than 1e-9.
std::optional<EstimateMemory> estimate_memory(const SampledLoop& loop) {
  constexpr std::size_t longest = 100000;
  const std::optional<EstimatorFactors> factors = estimator_factors(loop);
  if (!factors || divides_by_varying_interval(loop)) return std::nullopt;
  double slowest = 0;
  for (const EstimatorPole& pole : factors->poles) slowest = std::max(slowest, std::abs(pole.pole));
  const double samples = slowest > 0 ? std::log(1e-15) / std::log(slowest) : 0;
  if (!(samples < longest)) return std::nullopt;
  AveragedPulse pulse(*factors);
  EstimateMemory memory{0, 0};
  for (std::size_t j = 0; j < factors->taps.size() + std::size_t(samples); ++j) {
    const double weight = std::abs(pulse.next());
    memory.gain += weight;
    memory.age += double(j) * weight;
  }
  return EstimateMemory{std::max(1.0, memory.gain * (1 + 1e-9)), memory.age * (1 + 1e-9)};
}

}  // namespace dashpot::compiler
