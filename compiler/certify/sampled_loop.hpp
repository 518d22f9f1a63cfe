// The loop around a law as the certificate needs it: everything at the tool, in SI.
#pragma once

#include <dashpot/device_description.hpp>

#include "certify/motor_constants.hpp"
#include "decompose/port_device.hpp"

namespace dashpot::compiler {

struct SampledLoop {
  bool has_device = false;        // false: an ideal device, whose velocity is the difference of the last two samples
  double sample_period = 0;       // T [s]
  double jitter = 0;              // longest lateness of a sample [s]
  unsigned delay_samples = 0;     // n
  double write_earliest = 0;      // when a command acts at the earliest, counted from n samples after its own [s]
  double write_latest = 0;        // the same, at the latest [s]
  double amplifier_lag = 0;       // τ, first order [s]
  double tolerance = 0;           // ε of the brake [1]
  bool out_of_step = false;       // brake and motor follow a command that changes at different times
  double largest_speed = 0;       // [m/s]; 0: not stated
  double critical_speed = 0;      // v_c of b/(1 + (v/v_c)²) [m/s]; 0: the brake does not fade
  double max_damping = 0;         // of the brake, without the residual [N·s/m]; not used without a device
  double residual_damping = 0;    // of the brake at zero current [N·s/m]
  double device_damping = 0;      // the mechanics' own [N·s/m]
  double coulomb_friction = 0;    // [N]
  double encoder_step = 0;        // Δ [m]
  double max_force = 0;           // of the motor [N]; 0: unlimited
  double motor_slew = 0;          // of its force [N/s]; 0: unlimited
  double tool_speed = 0;          // the largest, at the tool [m/s]; 0: not stated
  double travel = 0;              // between the ends of the encoder's range, 0 among them [m]; 0: not stated
  velocity_description velocity;  // in the joint's coordinate
  double joint_encoder_step = 0;  // what the estimator is built with [m] or [rad]

  // T_max: longest time between two samples, or between two commands taking effect, whichever is longer [s].
  double longest_hold() const { return sample_period + jitter + (write_latest - write_earliest); }
  // Share of the longest hold during which the command before still acts.
  double late_share() const { return write_latest / longest_hold(); }
  bool is_late() const { return delay_samples > 0 || amplifier_lag > 0 || write_latest > 0; }
  // Whether all holds are of one length.
  bool is_punctual() const { return jitter == 0 && write_latest == write_earliest; }
  // Whether a sample may be read before the command of the sample before acts; nothing is proved then.
  bool may_overtake() const { return write_latest > 0 && write_latest > sample_period - jitter; }
};

// Why a loop is late: the worst of several reasons.
inline const char* why_late(const SampledLoop& loop) {
  if (loop.delay_samples > 0) return "the loop is delayed by \"delay_samples\"";
  return loop.write_latest > 0 ? "commands act later than their samples" : "the amplifier lags";
}

// The same without jitter, every command at its latest.
SampledLoop punctual(SampledLoop loop);

SampledLoop sampled_loop(const PortDevice& device, double sample_period);

// Physical damping at the tool, at least, while the brake is told `brake`: (1 − ε) b and the residual, both faded at
// the largest speed, and the mechanics'. Exact. Where the brake fades and no largest speed is stated, the mechanics'
// alone.
Rational assured_damping(const SampledLoop& loop, const Rational& brake);

// Of the brake's command, the share that is assured: (1 − ε)/(1 + (v/v_c)²).
Rational assured_share(const SampledLoop& loop);

}  // namespace dashpot::compiler
