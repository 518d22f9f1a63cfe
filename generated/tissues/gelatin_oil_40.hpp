// Gelatin phantom, 3 % gelatin with 40 % oil, under a 5 mm punch
//
// source: Nguyen et al. 2014, Ultrasound Med Biol 40:168, from the abstract: Voigt, mu 0.88 kPa, eta 1.06 Pa s. At
//   a flat punch of radius a = 5 mm on an incompressible half-space: f = 8 G a u, so 0.04 m times modulus and
//   viscosity
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly
// brake: makes b = 0.0424 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': dampers at
//   the tool in parallel add
// states: what the law remembers follows the measured position (position driven: on an ideal device position and
//   velocity do equally well)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: certified for any motion, any brake that makes at least the commanded damping: needs 0.0176 N·s/m by
//   a proof sample by sample, for commands that are held for up to 0.001 s; 0.0424 N·s/m is guaranteed
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion the law gives out no more work than stored_energy() decreases by; rounding changes the
//   force by at most 8.9e-16 of the sum of its terms' magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 0 additions, 1 multiplication, 0 guards against subnormal numbers
// cost of update(): 0 additions, 0 multiplications, 0 guards against subnormal numbers; 2 numbers kept between
//   samples
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved
//
// Written by dashpot 0.1.0 from a network with digest
// c44588cbfef7ccd37befa9845f2bf6f0d7d9931c4cac581682915a6856f263b1. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class gelatin_oil_40 {
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
    sampled_position_ = 0;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s].
  // After a non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    // m = f − b u̇
    const scalar force = static_stiffness * position;
    sampled_ = false;
    if (!dashpot::all_finite(velocity, force)) return {damping, 0};
    sampled_ = true;
    sampled_position_ = position;
    return {damping, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // u₋ = u
    last_position_ = sampled_position_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    // m = f − b u̇
    const scalar force = static_stiffness * position;
    if (!dashpot::all_finite(velocity, force)) {
      sampled_ = false;
      return {damping, 0};
    }
    // u₋ = u
    last_position_ = position;
    sampled_ = false;
    return {damping, force};
  }

  // No parameter of this network can be set while it runs.
  unsigned set(const parameters&) noexcept { return 0; }

  // Energy in the springs after the last update() [J].
  scalar stored_energy() const noexcept {
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = half_static_stiffness * last_position_ * last_position_;
    return stored;
  }

 private:
  static constexpr scalar damping = 0.0424;  // b, the brake's part
  static constexpr scalar static_stiffness = 35.2;  // k0 [N/m]
  static constexpr scalar half_static_stiffness = 17.6;  // ½ k0 [N/m]

  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
