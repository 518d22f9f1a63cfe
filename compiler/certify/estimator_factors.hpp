// A linear estimator divided by the one-sample difference, as factors that can be evaluated without cancellation:
//     Ĝ(w) = E(z) T/(1 − w) = Σ taps[i] wⁱ · Π 1/(1 − p w) · Π κ (1 + w)/(1 − p w),    w = z⁻¹,
// which is 1 at rest. The runtime's pulse_transfer has the same E with its denominator expanded, which cancels for slow
// filters, and for fast ones near Nyquist; here each pole keeps its distances from 1 and from −1, and a zero at −1
// stays with the pole that it is there for.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "certify/sampled_loop.hpp"

namespace dashpot::compiler {

struct EstimatorPole {
  std::complex<double> pole;  // p
  std::complex<double> loss;  // 1 − p, without cancellation
  std::complex<double> rest;  // 1 + p, without cancellation
  std::complex<double> gain;  // κ of a pole with a zero at −1; 0 of one without

  bool has_zero() const { return gain != 0.0; }
  // 1 − |p|², without cancellation: Re (1 − p)(1 + p̄).
  double norm_loss() const { return (loss * std::conj(rest)).real(); }
};

struct EstimatorFactors {
  std::vector<double> taps = {1};
  std::vector<EstimatorPole> poles;
};

// Ĝ's answer r_j to a unit pulse: the estimate of velocity is (r_j − r_{j−1})/T.
class AveragedPulse {
 public:
  explicit AveragedPulse(const EstimatorFactors& estimator)
      : estimator_(estimator), states_(estimator.poles.size()), inputs_(estimator.poles.size()) {}

  std::complex<double> next() {
    std::complex<double> value = place_ < estimator_.taps.size() ? estimator_.taps[place_] : 0;
    ++place_;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const EstimatorPole& pole = estimator_.poles[i];
      const std::complex<double> input = pole.has_zero() ? pole.gain * (value + inputs_[i]) : value;
      inputs_[i] = value;
      value = states_[i] = pole.pole * states_[i] + input;
    }
    return value;
  }

  // Upper bound of Σ|r_j| over all samples still to come, once the taps are over: 1/(1 − |p|) of each pole's state and
  // input; a zero doubles the input.
  double rest() const {
    double sum = 0;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const EstimatorPole& pole = estimator_.poles[i];
      const double size = std::abs(pole.pole);
      const double input = pole.has_zero() ? std::abs(pole.gain) * (2 * sum + std::abs(inputs_[i])) : sum;
      sum = (size * std::abs(states_[i]) + input) * (1 + size) / pole.norm_loss();
    }
    return sum;
  }

  // True when what is still to come is less than 1e-15 of the sum of all r, which is 1.
  bool is_over() const { return place_ > estimator_.taps.size() && rest() < 1e-15; }

 private:
  const EstimatorFactors& estimator_;
  std::vector<std::complex<double>> states_, inputs_;
  std::size_t place_ = 0;
};

// Empty for an estimator that is not linear in the positions it is given, and for one so fast that its recursion, as
// rounded, no longer dies away. Of one that divides by the time that has passed: at a constant period.
std::optional<EstimatorFactors> estimator_factors(const SampledLoop& loop);

// Whether the estimate divides by the time between two samples, on a device whose samples are not punctual.
bool divides_by_varying_interval(const SampledLoop& loop);

// Upper bound of γ in ‖v̂‖₂ ≤ γ ‖Δu/T‖₂ for any motion: Σ|taps| Π 1/(1 − |p|); 1 for Butterworth's filters, which never
// amplify; T over the shortest interval if the estimate divides by the interval; or that of an adaptive window. Empty
// if nothing is known.
std::optional<double> estimate_gain(const SampledLoop& loop);

// How far an estimate h v̂(k) = Σ_j e_j Δu(k + 1 − j), j = 1 …, depends on the past; upper bounds.
struct EstimateMemory {
  double gain;  // Σ |e_j|
  double age;   // Σ |e_j| (j − 1) [samples]
};

// Empty for an estimator whose weights change, and for one that remembers more than 100,000 samples.
std::optional<EstimateMemory> estimate_memory(const SampledLoop& loop);

}  // namespace dashpot::compiler
