// Motors and loops for the tests of the certificate, written down constant by constant.
#pragma once

#include <cmath>

#include "certify/certificate.hpp"

namespace dashpot::compiler {

inline SampledLoop plain_loop(double sample_period) {
  SampledLoop loop;
  loop.sample_period = sample_period;
  return loop;
}

inline SampledLoop differencing_loop(double sample_period, unsigned window) {
  SampledLoop loop = plain_loop(sample_period);
  loop.has_device = true;
  loop.velocity.estimator = estimator_kind::backward_difference;
  loop.velocity.window = window;
  return loop;
}

inline MotorConstants spring_motor(double stiffness) {
  MotorConstants motor;
  motor.static_stiffness = stiffness;
  motor.half_static_stiffness = stiffness / 2;
  return motor;
}

inline MotorConstants damper_motor(double damping) {
  MotorConstants motor;
  motor.velocity_gain = damping;
  return motor;
}

// A Maxwell element of the exact scheme; driven by position, or by the estimate.
inline void add_maxwell(MotorConstants& motor, double stiffness, double rate, double sample_period, bool by_position) {
  MotorMode mode;
  mode.decay = std::exp(-rate * sample_period);
  mode.loss = 1 - mode.decay;
  const double gain = stiffness * -std::expm1(-rate * sample_period) / (rate * sample_period);
  (by_position ? mode.position_drive : mode.velocity_drive) = mode.decay * gain * (by_position ? 1 : sample_period);
  mode.energy_weight = 1 / (2 * stiffness * mode.decay * mode.decay);
  motor.modes.push_back(mode);
  (by_position ? motor.step_stiffness : motor.velocity_gain) += gain * (by_position ? 1 : sample_period);
}

inline SampledBound bound_of(const MotorConstants& motor, const SampledLoop& loop) {
  const EstimatorFactors estimator = estimator_factors(loop).value();
  return sampled_bound(NeededDamping(motor, loop, estimator), loop.sample_period);
}

}  // namespace dashpot::compiler
