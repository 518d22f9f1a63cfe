#include "certify/sampled_loop.hpp"

#include <algorithm>

namespace dashpot::compiler {
namespace {

// 1/(1 + (v/v_c)²)
Rational share_at_speed(const SampledLoop& loop) {
  if (loop.critical_speed == 0) return 1;
  if (loop.largest_speed == 0) return 0;
  const Rational ratio = Rational(loop.largest_speed) / Rational(loop.critical_speed);
  return 1 / (1 + ratio * ratio);
}

}  // namespace

SampledLoop sampled_loop(const PortDevice& device, double sample_period) {
  SampledLoop loop;
  loop.sample_period = sample_period;
  const device_description& joint = device.description();
  loop.has_device = !device.is_ideal();
  loop.jitter = joint.loop.jitter;
  loop.delay_samples = joint.loop.delay_samples;
  loop.write_earliest = joint.loop.write_earliest;
  loop.write_latest = joint.loop.write_latest;
  loop.amplifier_lag = joint.motor.amplifier_lag;
  loop.tolerance = joint.brake.tolerance;
  loop.out_of_step = !joint.brake.follows_at_once() || joint.motor.amplifier_lag > 0;
  loop.largest_speed = joint.encoder.max_speed;  // only their ratio counts: no conversion to the tool
  loop.critical_speed = joint.brake.critical_speed;
  loop.max_damping = device.max_damping().value_or(0);
  loop.residual_damping = joint.brake.residual_damping * device.damping_scale();
  loop.device_damping = joint.mechanics.damping * device.damping_scale();
  loop.coulomb_friction = joint.mechanics.coulomb_friction / device.position_scale();
  loop.encoder_step = joint.encoder.step * device.position_scale();
  loop.max_force = joint.motor.max_torque / device.position_scale();
  loop.motor_slew = joint.motor.slew / device.position_scale();
  loop.tool_speed = joint.encoder.max_speed * device.position_scale();
  if (joint.encoder.range_low != joint.encoder.range_high)
    loop.travel =
        (std::max(joint.encoder.range_high, 0.0) - std::min(joint.encoder.range_low, 0.0)) * device.position_scale();
  loop.velocity = joint.velocity;
  loop.joint_encoder_step = joint.encoder.step;
  return loop;
}

SampledLoop punctual(SampledLoop loop) {
  loop.jitter = 0;
  loop.write_earliest = loop.write_latest;
  return loop;
}

Rational assured_share(const SampledLoop& loop) { return (1 - Rational(loop.tolerance)) * share_at_speed(loop); }

Rational assured_damping(const SampledLoop& loop, const Rational& brake) {
  return assured_share(loop) * brake + share_at_speed(loop) * Rational(loop.residual_damping) +
         Rational(loop.device_damping);
}

}  // namespace dashpot::compiler
