// Maxwell element with the damper at the tool, Fig. 4b
//
// source: Gosline & Hayward 2009, Fig. 4b and (16)-(19); values of Fig. 6
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly
// brake: makes b = 5 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': in series, B
//   dissipates 100 % of the energy at low frequency, so that the brake makes its 5 N s/m
// states: what the law remembers follows the estimated velocity (velocity driven as asked)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: certified for any motion, samples at 1000 Hz: needs 4.95449 N·s/m, the most at 18.8949 Hz; 5 N·s/m is
//   guaranteed
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 1 addition, 1 multiplication, 0 guards against subnormal numbers
// cost of update(): 1 addition, 2 multiplications, 1 guard against subnormal numbers; 2 numbers kept between
//   samples
// rounding: the force of a mode is off by at most 3.4e-14 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// 1da822b838c0f77f8432457e47bc3cdeb6bb0dd5f782f58b2b5899e36f35eb79. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class maxwell_damper_at_tool {
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
    static_cast<void>(position);
    B_K_force_ = 0;
    sampled_velocity_ = 0;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s].
  // After a non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    // m = f − b u̇
    const scalar force = B_K_force_ + velocity_gain * velocity;
    sampled_ = false;
    if (!dashpot::all_finite(position, force)) return {damping, 0};
    sampled_ = true;
    sampled_velocity_ = velocity;
    return {damping, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // F ← a (F + c Δu)
    B_K_force_ = dashpot::relaxed(threshold, B_K_decay, B_K_force_, B_K_velocity_drive * sampled_velocity_);
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    // m = f − b u̇
    const scalar force = B_K_force_ + velocity_gain * velocity;
    if (!dashpot::all_finite(position, force)) {
      sampled_ = false;
      return {damping, 0};
    }
    // F ← a (F + c Δu)
    B_K_force_ = dashpot::relaxed(threshold, B_K_decay, B_K_force_, B_K_velocity_drive * velocity);
    sampled_ = false;
    return {damping, force};
  }

  // No parameter of this network can be set while it runs.
  unsigned set(const parameters&) noexcept { return 0; }

  // Energy in the springs after the last update() [J].
  scalar stored_energy() const noexcept {
    // F²/(2k)
    const scalar B_K_energy = B_K_energy_weight * B_K_force_ * B_K_force_;
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = B_K_energy;
    return stored;
  }

 private:
  static constexpr scalar damping = 5.0;  // b, the brake's part
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar velocity_gain = -4.95024916874584;  // b∞ − b + h Σ c_i, force for an estimated velocity [N·s/m]
  static constexpr scalar B_K_velocity_drive = 0.04925580221206376;  // a c h [N·s/m]
  static constexpr scalar B_K_decay = 0.9900498337491681;  // a = e^{−λh} [1]
  static constexpr scalar B_K_energy_weight = 0.010202013400267558;  // 1/(2 k a²) [m/N]

  scalar B_K_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar sampled_velocity_ = 0;  // estimate of u̇, at this sample [m/s]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
