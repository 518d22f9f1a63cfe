#include "certify/quantisation.hpp"

#include <algorithm>
#include <cmath>

#include "certify/adaptive_window.hpp"

namespace dashpot::compiler {
namespace {

// The motor under q_0 = 1, then 0. A mode is G_{j+1} = x_j − α P_j with x = d q + (e/T) r, P_{j+1} = a P_j + x_j: the
// differences that drive it, summed by parts, so that nothing cancels however slow it is.
class MotorPulse {
 public:
  MotorPulse(const MotorConstants& motor, double sample_period)
      : motor_(motor), period_(sample_period), sums_(motor.modes.size()) {}

  // h_j
  double next(double q, double r) {
    const double pulse = motor_.static_stiffness * q + motor_.step_stiffness * (q - last_q_) +
                         motor_.velocity_gain * (r - last_r_) / period_ + mode_force_;
    mode_force_ = 0;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const MotorMode& mode = motor_.modes[i];
      const double drive = mode.position_drive * q + mode.velocity_drive / period_ * r;
      mode_force_ += drive - mode.loss * sums_[i];
      sums_[i] = mode.decay * sums_[i] + drive;
    }
    last_q_ = q;
    last_r_ = r;
    return pulse;
  }

  // Upper bound of Σ|h_j| over all samples still to come, with q = 0 and Σ|r| at most `rest`. A mode still makes −α P,
  // −α a P, …, which sums to −P.
  double to_come(double rest) const {
    double of_sums = 0, of_rest = std::abs(motor_.velocity_gain);
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      of_sums += std::abs(sums_[i]);
      of_rest += std::abs(motor_.modes[i].velocity_drive);
    }
    const double of_next = std::abs(mode_force_) + std::abs(motor_.velocity_gain * last_r_) / period_;
    return std::abs(motor_.step_stiffness * last_q_) + of_next + of_sums + 2 * of_rest * rest / period_;
  }

 private:
  const MotorConstants& motor_;
  double period_;
  std::vector<double> sums_;
  double mode_force_ = 0, last_q_ = 0, last_r_ = 0;
};

constexpr std::size_t longest_pulse = 100'000;  // samples; the rest is bounded by to_come()
constexpr std::size_t between_looks = 16;       // samples; to_come() takes longer than a sample

double sum_of_pulse(const MotorConstants& motor, const SampledLoop& loop, const EstimatorFactors& estimator) {
  MotorPulse pulse(motor, loop.sample_period);
  AveragedPulse averaged(estimator);
  const bool follows = motor.follows_estimate();
  double sum = std::abs(pulse.next(1, follows ? averaged.next().real() : 0));
  sum += std::abs(pulse.next(0, follows ? averaged.next().real() : 0));
  for (std::size_t j = 0; follows && j < longest_pulse; ++j) {
    if (j % between_looks == 0 && averaged.is_over()) break;
    sum += std::abs(pulse.next(0, averaged.next().real()));
  }
  return sum + pulse.to_come(follows ? averaged.rest() : 0);
}

}  // namespace

std::optional<double> quantisation_gain(const MotorConstants& motor, const SampledLoop& loop) {
  if (!motor.follows_estimate()) return sum_of_pulse(motor, loop, {});
  const bool divides = divides_by_varying_interval(loop);
  if (const auto linear = divides ? std::nullopt : estimator_factors(loop)) return sum_of_pulse(motor, loop, *linear);
  if (!(divides ? estimate_gain(loop) : adaptive_window_gain(loop)) || motor.estimate_drives_modes())
    return std::nullopt;
  const double shortest = divides ? loop.sample_period - loop.jitter : loop.sample_period;
  return sum_of_pulse(position_driven(motor), loop, {}) + 2 * std::abs(motor.velocity_gain) / shortest;
}

std::optional<double> estimate_pulse(const SampledLoop& loop) {
  MotorConstants estimate;
  estimate.velocity_gain = 1;
  return quantisation_gain(estimate, loop);
}

std::optional<double> quantisation_gain(const MotorConstants& linear, const SlipMotor& slips, const SampledLoop& loop) {
  const double compensation = slips.compensation + slips.held_compensation;
  const std::optional<double> pulse = compensation > 0 ? estimate_pulse(loop) : 0;
  const std::optional<double> beside = quantisation_gain(motor_beside(slips, linear), loop);
  if (!pulse || !beside || slips.slides_within_step) return std::nullopt;
  return *beside + slips.held_gain + compensation * *pulse;
}

}  // namespace dashpot::compiler
