// Two Kelvin elements in series, Fig. 3
//
// source: Gosline & Hayward 2009, Fig. 3 and (10)-(11); the paper prints no values, these are chosen here
// scheme: backward-euler at 1000 Hz, double: the paper's own, whose error falls in proportion to the period
// brake: makes b = 6 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': in series, (K2 |
//   B2) dissipates 90.36 % of the energy at low frequency, so that the brake makes its 6 N s/m
// states: what the law remembers follows position and velocity, as the network's nodes have it (nodal driven as
//   asked)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: certified for any motion, samples at 1000 Hz: needs 3.56961 N·s/m, the most at 22.435 Hz; 6 N·s/m is
//   guaranteed
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 4 additions, 3 multiplications, 0 guards against subnormal numbers
// cost of update(): 2 additions, 3 multiplications, 1 guard against subnormal numbers; 5 numbers kept between
//   samples
// rounding: the force of a mode is off by at most 1.2e-14 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// 568aa916d322e556af757b430ca7c246b5eba538d99702a6ca3cab14fe37fc1d. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class generalised_kelvin_two {
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
    K1_B1_K2_B2_force_ = 0;
    sampled_velocity_ = 0;
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
    const scalar force = K1_B1_K2_B2_force_ + static_stiffness * position + (step_stiffness * position_change +
        velocity_gain * velocity);
    sampled_ = false;
    if (!dashpot::all_finite(force)) return {damping, 0};
    sampled_ = true;
    sampled_velocity_ = velocity;
    sampled_position_change_ = position_change;
    sampled_position_ = position;
    return {damping, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // F ← a (F + c Δu)
    K1_B1_K2_B2_force_ = dashpot::relaxed(threshold, K1_B1_K2_B2_decay, K1_B1_K2_B2_force_,
        K1_B1_K2_B2_gain * sampled_position_change_ + K1_B1_K2_B2_velocity_drive * sampled_velocity_);
    // u₋ = u
    last_position_ = sampled_position_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    // m = f − b u̇
    const scalar force = K1_B1_K2_B2_force_ + static_stiffness * position + (step_stiffness * position_change +
        velocity_gain * velocity);
    if (!dashpot::all_finite(force)) {
      sampled_ = false;
      return {damping, 0};
    }
    // F ← a (F + c Δu)
    K1_B1_K2_B2_force_ = dashpot::relaxed(threshold, K1_B1_K2_B2_decay, K1_B1_K2_B2_force_,
        K1_B1_K2_B2_gain * position_change + K1_B1_K2_B2_velocity_drive * velocity);
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
    const scalar K1_B1_K2_B2_energy = K1_B1_K2_B2_energy_weight * K1_B1_K2_B2_force_ * K1_B1_K2_B2_force_;
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = half_static_stiffness * last_position_ * last_position_ + K1_B1_K2_B2_energy;
    return stored;
  }

 private:
  static constexpr scalar damping = 6.0;  // b, the brake's part
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar static_stiffness = 57.142857142857146;  // k0 [N/m]
  static constexpr scalar step_stiffness = -24.458032240133406;  // Σ c_i, stiffness of all modes within a sample [N/m]
  static constexpr scalar velocity_gain = -3.5486381322957197;  // b∞ − b + h Σ c_i, force for an estimated velocity [N·s/m]
  static constexpr scalar K1_B1_K2_B2_gain = -23.791860155771797;  // a c [N/m]
  static constexpr scalar K1_B1_K2_B2_velocity_drive = 0.049962906327120776;  // a c h [N·s/m]
  static constexpr scalar K1_B1_K2_B2_decay = 0.9727626459143969;  // a = 1/(1 + λh) [1]
  static constexpr scalar half_static_stiffness = 28.571428571428573;  // ½ k0 [N/m]
  static constexpr scalar K1_B1_K2_B2_energy_weight = 0.0191050826446281;  // 1/(2 k a²) [m/N]

  scalar K1_B1_K2_B2_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar sampled_velocity_ = 0;  // estimate of u̇, at this sample [m/s]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
