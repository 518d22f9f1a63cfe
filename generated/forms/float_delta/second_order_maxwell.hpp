// General viscoelastic solid, Fig. 2e
//
// source: Gosline & Hayward 2009, Fig. 5
// scheme: exact at 1000 Hz, float: a motion that is straight between two samples is answered exactly
// brake: makes b = 11 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': in series, B1
//   dissipates 100 % of the energy at low frequency, so that the brake makes its 5 N s/m; in series, B2 dissipates
//   100 % of the energy at low frequency, so that the brake makes its 6 N s/m
// states: what the law remembers follows the measured position (position driven: on an ideal device position and
//   velocity do equally well)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: certified for any motion, samples at 1000 Hz: needs 10.9819 N·s/m, the most at 8.53085 Hz; 11 N·s/m
//   is guaranteed
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion the law gives out no more work than stored_energy() decreases by; rounding changes the
//   force by at most 3.7e-05 of the sum of its terms' magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 4 additions, 3 multiplications, 0 guards against subnormal numbers
// cost of update(): 5 additions, 4 multiplications, 2 guards against subnormal numbers; 6 numbers kept between
//   samples
// rounding: in delta form the force of a mode is off by at most 3.6e-05 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// af2735eee93eb33a8f9a4a4f82c0acd10271a91cc25bb6eaf3dfce559e6694af. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class second_order_maxwell {
 public:
  using scalar = float;
  static constexpr scalar sample_period = 0.001f;  // [s]
  static constexpr dashpot::motion port_motion = dashpot::motion::translation;

  // The part of the brake's command that was added for passivity: it is felt in addition to the network.
  static constexpr scalar added_damping = 0.0f;

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
    relaxed_force_ = 0;
    B2_K2_force_ = 0;
    B1_K1_force_ = 0;
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
    const scalar force = relaxed_force_ + static_stiffness * position + (step_stiffness * position_change +
        velocity_gain * velocity);
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
    // F ← F + (a c Δu − α F)
    // B2, K2
    B2_K2_force_ = dashpot::flush_below(threshold, B2_K2_force_ +
        (B2_K2_gain * sampled_position_change_ - B2_K2_loss * B2_K2_force_));
    // B1, K1
    B1_K1_force_ = dashpot::flush_below(threshold, B1_K1_force_ +
        (B1_K1_gain * sampled_position_change_ - B1_K1_loss * B1_K1_force_));
    // S = Σ a_i F_i
    relaxed_force_ = B2_K2_force_ + B1_K1_force_;
    // u₋ = u
    last_position_ = sampled_position_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    // m = f − b u̇
    const scalar force = relaxed_force_ + static_stiffness * position + (step_stiffness * position_change +
        velocity_gain * velocity);
    if (!dashpot::all_finite(force)) {
      sampled_ = false;
      return {damping, 0};
    }
    // F ← F + (a c Δu − α F)
    // B2, K2
    B2_K2_force_ = dashpot::flush_below(threshold, B2_K2_force_ +
        (B2_K2_gain * position_change - B2_K2_loss * B2_K2_force_));
    // B1, K1
    B1_K1_force_ = dashpot::flush_below(threshold, B1_K1_force_ +
        (B1_K1_gain * position_change - B1_K1_loss * B1_K1_force_));
    // S = Σ a_i F_i
    relaxed_force_ = B2_K2_force_ + B1_K1_force_;
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
    const scalar B2_K2_energy = B2_K2_energy_weight * B2_K2_force_ * B2_K2_force_;  // B2, K2
    const scalar B1_K1_energy = B1_K1_energy_weight * B1_K1_force_ * B1_K1_force_;  // B1, K1
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = half_static_stiffness * last_position_ * last_position_ + (B2_K2_energy + B1_K1_energy);
    return stored;
  }

 private:
  static constexpr scalar damping = 11.0f;  // b, the brake's part
  static constexpr scalar threshold = 8.6736174e-19f;  // smaller forces become zero: no state is subnormal
  static constexpr scalar static_stiffness = 5.0f;  // k0 [N/m]
  static constexpr scalar step_stiffness = 21.977283f;  // Σ c_i, stiffness of all modes within a sample [N/m]
  static constexpr scalar velocity_gain = -11.0f;  // b∞ − b [N·s/m]
  static constexpr scalar B2_K2_gain = 9.975033f;  // a c [N/m]
  static constexpr scalar B1_K1_gain = 11.956881f;  // a c [N/m]
  static constexpr scalar B2_K2_loss = 0.0016652786f;  // α = 1 − a [1]
  static constexpr scalar B1_K1_loss = 0.0023971223f;  // α = 1 − a [1]
  static constexpr scalar half_static_stiffness = 2.5f;  // ½ k0 [N/m]
  static constexpr scalar B2_K2_energy_weight = 0.050166946f;  // 1/(2 k a²) [m/N]
  static constexpr scalar B1_K1_energy_weight = 0.041867148f;  // 1/(2 k a²) [m/N]

  scalar relaxed_force_ = 0;  // sum of the modes' forces, decayed to the next sample [N]
  scalar B2_K2_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar B1_K1_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
