// Maxwell element with the spring at the tool, Fig. 4a
//
// source: Gosline & Hayward 2009, Fig. 4a and (12)-(15); values of Fig. 6
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly
// brake: makes b = 5 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': in series, B
//   dissipates 100 % of the energy at low frequency, so that the brake makes its 5 N s/m
// states: what the law remembers follows the measured position (position driven: on an ideal device position and
//   velocity do equally well)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: certified for any motion, samples at 1000 Hz: needs 4.95449 N·s/m, the most at 18.8943 Hz; 5 N·s/m is
//   guaranteed
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion the law gives out no more work than stored_energy() decreases by; rounding changes the
//   force by at most 3.5e-14 of the sum of its terms' magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 3 additions, 2 multiplications, 0 guards against subnormal numbers
// cost of update(): 1 addition, 2 multiplications, 1 guard against subnormal numbers; 4 numbers kept between
//   samples
// rounding: the force of a mode is off by at most 3.4e-14 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// 446b14ebf72580ca0389617a12faffa2eb33a284323bfdf8b952104a26d1c1e3. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class maxwell_spring_at_tool {
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
    K_B_force_ = 0;
    sampled_position_change_ = 0;
    sampled_position_ = 0;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s].
  // After a non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    // m = f − b u̇
    const scalar force = K_B_force_ + (step_stiffness * position_change + velocity_gain * velocity);
    sampled_ = false;
    if (!dashpot::all_finite(force)) return {damping, 0};
    sampled_ = true;
    sampled_position_change_ = position_change;
    sampled_position_ = position;
    return {damping, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // F ← a (F + c Δu)
    K_B_force_ = dashpot::relaxed(threshold, K_B_decay, K_B_force_, K_B_gain * sampled_position_change_);
    // u₋ = u
    last_position_ = sampled_position_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    // m = f − b u̇
    const scalar force = K_B_force_ + (step_stiffness * position_change + velocity_gain * velocity);
    if (!dashpot::all_finite(force)) {
      sampled_ = false;
      return {damping, 0};
    }
    // F ← a (F + c Δu)
    K_B_force_ = dashpot::relaxed(threshold, K_B_decay, K_B_force_, K_B_gain * position_change);
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
    const scalar K_B_energy = K_B_energy_weight * K_B_force_ * K_B_force_;
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = K_B_energy;
    return stored;
  }

 private:
  static constexpr scalar damping = 5.0;  // b, the brake's part
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar step_stiffness = 49.750831254159735;  // Σ c_i, stiffness of all modes within a sample [N/m]
  static constexpr scalar velocity_gain = -5.0;  // b∞ − b [N·s/m]
  static constexpr scalar K_B_gain = 49.255802212063756;  // a c [N/m]
  static constexpr scalar K_B_decay = 0.9900498337491681;  // a = e^{−λh} [1]
  static constexpr scalar K_B_energy_weight = 0.010202013400267558;  // 1/(2 k a²) [m/N]

  scalar K_B_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
