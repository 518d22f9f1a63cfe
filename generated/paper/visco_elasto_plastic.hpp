// A needle that sticks and slides, Fig. 10
//
// source: Gosline & Hayward 2009, Fig. 10 and (21); the paper prints no values, these are chosen here
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly, except in
//   samples in which a slip or a contact changes
// brake: makes b = 2.5 N·s/m of damping and, in the parts with slips, what the next lines give, and the motor the
//   rest of the force; by the rule 'faithful': without a device 'faithful' is the paper's rule: dampers at the
//   tool in parallel add
// slip rule of Y: steady, of the slip rules with an error of up to 5 %, the one with the largest mean damping of
//   the brake, 3.3 N s/m; its error is 2.04e-05 %; b = 0.8 N·s/m stuck, 0.8 sliding
// states: what the law remembers follows the measured position (position driven: on an ideal device position and
//   velocity do equally well)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: certified for any motion, whichever slips slide or stick and whether the tool touches or not, any
//   brake that makes at least the commanded damping: needs 1.3 N·s/m by a proof sample by sample, for commands
//   that are held for up to 0.001 s; 3.3 N·s/m is guaranteed
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion no part gives out more work than it has stored, and slips and contacts only dissipate
//   energy; rounding changes the force by at most 1.4e-15 of the sum of its terms' magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 5 additions, 3 multiplications, 0 guards against subnormal numbers
// cost of update(): 1 addition, 1 multiplication, 1 guard against subnormal numbers; 6 numbers kept between
//   samples
// rounding: the force of a mode is off by at most 5.6e-16 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// 641bd9a185539eb5b87be22748db07e1bc3e1f20f78caf1bfff209cfd4314851. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class visco_elasto_plastic {
 public:
  using scalar = double;
  static constexpr scalar sample_period = 0.001;  // [s]
  static constexpr dashpot::motion port_motion = dashpot::motion::translation;

  // The part of the brake's command that was added for passivity: it is felt in addition to the network.
  static constexpr scalar added_damping = 0.0;

  // What the servo loop compares with the device that it drives.
  struct certified_for {
    static constexpr bool any_device = true;
    static constexpr const char* device = "ideal";
    static constexpr const char* device_digest = "";
    static constexpr const char* estimator = "exact";
    static constexpr unsigned loop_delay = 0;  // [samples]
    static constexpr bool is_certified = true;
  };

  struct parameters {};

  // Starts at rest at `position` [m]: only the springs that hold a force at rest are loaded, from 0. A
  // NaN or infinite position counts as 0.
  void reset(scalar position = 0) noexcept {
    last_position_ = dashpot::all_finite(position, position, position) ? position : 0;
    K_spring_force_ = 0;
    sampled_position_change_ = 0;
    sampled_Y_trial_ = 0;
    sampled_Y_excess_ = 0;
    sampled_position_ = 0;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s].
  // After a non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    // trial = force of the slip if it held
    const scalar Y_trial = Y_trial_by_change * position_change + K_spring_force_;
    // slip = clamp(trial, ±Y)
    const scalar Y_slip = dashpot::clamp_to(Y_yield, Y_trial);
    // excess = trial − slip
    const scalar Y_excess = Y_trial - Y_slip;
    // m = f − b u̇
    const scalar force = Y_trial - Y_force_by_excess * Y_excess - slips_compensation * velocity;
    sampled_ = false;
    if (!dashpot::all_finite(force)) return {damping, 0};
    sampled_ = true;
    sampled_position_change_ = position_change;
    sampled_Y_trial_ = Y_trial;
    sampled_Y_excess_ = Y_excess;
    sampled_position_ = position;
    return {damping, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // F ← F + k δ
    K_spring_force_ = dashpot::flush_below(threshold, sampled_Y_trial_ - Y_K_spring_by_excess * sampled_Y_excess_);
    // u₋ = u
    last_position_ = sampled_position_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    // trial = force of the slip if it held
    const scalar Y_trial = Y_trial_by_change * position_change + K_spring_force_;
    // slip = clamp(trial, ±Y)
    const scalar Y_slip = dashpot::clamp_to(Y_yield, Y_trial);
    // excess = trial − slip
    const scalar Y_excess = Y_trial - Y_slip;
    // m = f − b u̇
    const scalar force = Y_trial - Y_force_by_excess * Y_excess - slips_compensation * velocity;
    if (!dashpot::all_finite(force)) {
      sampled_ = false;
      return {damping, 0};
    }
    // F ← F + k δ
    K_spring_force_ = dashpot::flush_below(threshold, Y_trial - Y_K_spring_by_excess * Y_excess);
    // u₋ = u
    last_position_ = position;
    sampled_ = false;
    return {damping, force};
  }

  // No parameter of this network can be set while it runs.
  unsigned set(const parameters&) noexcept { return 0; }

  // Energy in the springs after the last update() [J].
  scalar stored_energy() const noexcept {
    // F²/(2k)
    const scalar K_spring_energy = K_compliance * K_spring_force_ * K_spring_force_;
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = K_spring_energy;
    return stored;
  }

 private:
  static constexpr scalar damping = 3.3;  // b, the brake's part
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar Y_trial_by_change = 1000.0;  // factor of the change of position [N/m]
  static constexpr scalar Y_yield = 0.5;  // Y [N]
  static constexpr scalar Y_force_by_excess = 0.5555555555555556;  // factor of the excess [1]
  static constexpr scalar slips_compensation = 0.7999991999992;  // β, damping of the brake that the motor takes back [N·s/m]
  static constexpr scalar Y_K_spring_by_excess = 0.5555555555555556;  // factor of the excess [1]
  static constexpr scalar K_compliance = 0.0005;  // 1/(2 k) [m/N]

  scalar K_spring_force_ = 0;  // force of the spring [N]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar sampled_Y_trial_ = 0;  // force of the slip if it held, at this sample [N]
  scalar sampled_Y_excess_ = 0;  // what the slip does not hold, at this sample [N]
  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
