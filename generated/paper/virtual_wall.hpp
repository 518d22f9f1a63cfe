// Virtual wall: a contact with a Kelvin element
//
// source: Gosline & Hayward 2009, section 5.1 and (9); stiffness and damping are chosen, not printed
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly, except in
//   samples in which a slip or a contact changes
// brake: makes b = 5 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': dampers at the
//   tool in parallel add
// states: what the law remembers follows the measured position (position driven, as a network with a contact
//   always is)
// contact: at 0 m; brake and motor 0 while the tool is free
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: not certified: the brake leaves a free tool alone, so that in the sample of the touch only the
//   device's own damping acts; 10.25 N·s/m of damping are needed, 0 is guaranteed
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion no part gives out more work than it has stored, and slips and contacts only dissipate
//   energy; rounding changes the force by at most 1.1e-15 of the sum of its terms' magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 6 additions, 4 multiplications, 1 guard against subnormal numbers
// cost of update(): 0 additions, 0 multiplications, 0 guards against subnormal numbers; 3 numbers kept between
//   samples
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved
//
// Written by dashpot 0.1.0 from a network with digest
// 2f3f76a19a6f4d740be997cf81ac93892771e81493edbad696d8ba09ac2d73f7. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class virtual_wall {
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
    static constexpr bool is_certified = false;
  };

  struct parameters {};

  // Starts at rest at `position` [m]: only the springs that hold a force at rest are loaded, from 0. A
  // NaN or infinite position counts as 0.
  void reset(scalar position = 0) noexcept {
    if (!dashpot::all_finite(position)) position = 0;
    // s = (u − u0)⁺
    const scalar pushed_in = position > 0 ? position : none;
    surface_ = dashpot::all_finite(pushed_in) ? pushed_in : 0;
    sampled_brake_ = 0;
    sampled_surface_now_ = 0;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s].
  // After a non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    // Δ = u − s₋
    const scalar approach = position - surface_;
    // k0 s₋ + S
    const scalar held_force = static_stiffness * surface_;
    // Δs where f = 0: −held force/g
    const scalar surface_recovery = recovery_compliance * held_force;
    // Δs = Δ, but no lower than where f = 0
    const scalar surface_change = surface_recovery - approach > 0 ? surface_recovery : approach;
    // gap = s − u
    const scalar gap = surface_change - approach;
    // s = s₋ + Δs
    const scalar surface_now = gap > 0 ? dashpot::flush_below(threshold, surface_ + surface_change) : position;
    // f′ = f − b∞ Δs/h
    const scalar opposing = static_stiffness * surface_now;
    // −(f′ + b∞ v̂)
    const scalar pull = none - (opposing + feedthrough * velocity);
    // above 0 where the tool is free
    const scalar released = pull > 0 ? pull : gap;
    // b = 0 of a free tool
    const scalar brake = released > 0 ? none : contact_damping;
    // m = f − b u̇ of a tool that touches
    const scalar force = released > 0 ? none : opposing;
    sampled_ = false;
    if (!dashpot::all_finite(position, velocity, force)) return {sampled_brake_, 0};
    sampled_ = true;
    sampled_brake_ = brake;
    sampled_surface_now_ = surface_now;
    return {brake, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // s₋ = s
    surface_ = sampled_surface_now_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    // Δ = u − s₋
    const scalar approach = position - surface_;
    // k0 s₋ + S
    const scalar held_force = static_stiffness * surface_;
    // Δs where f = 0: −held force/g
    const scalar surface_recovery = recovery_compliance * held_force;
    // Δs = Δ, but no lower than where f = 0
    const scalar surface_change = surface_recovery - approach > 0 ? surface_recovery : approach;
    // gap = s − u
    const scalar gap = surface_change - approach;
    // s = s₋ + Δs
    const scalar surface_now = gap > 0 ? dashpot::flush_below(threshold, surface_ + surface_change) : position;
    // f′ = f − b∞ Δs/h
    const scalar opposing = static_stiffness * surface_now;
    // −(f′ + b∞ v̂)
    const scalar pull = none - (opposing + feedthrough * velocity);
    // above 0 where the tool is free
    const scalar released = pull > 0 ? pull : gap;
    // b = 0 of a free tool
    const scalar brake = released > 0 ? none : contact_damping;
    // m = f − b u̇ of a tool that touches
    const scalar force = released > 0 ? none : opposing;
    if (!dashpot::all_finite(position, velocity, force)) {
      sampled_ = false;
      return {sampled_brake_, 0};
    }
    sampled_brake_ = brake;
    // s₋ = s
    surface_ = surface_now;
    sampled_ = false;
    return {brake, force};
  }

  // No parameter of this network can be set while it runs.
  unsigned set(const parameters&) noexcept { return 0; }

  // Energy in the springs after the last update() [J].
  scalar stored_energy() const noexcept {
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = half_static_stiffness * surface_ * surface_;
    return stored;
  }

 private:
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar static_stiffness = 500.0;  // k0 [N/m]
  static constexpr scalar none = 0.0;  // no force on a free tool [N]
  static constexpr scalar recovery_compliance = -0.0001818181818181818;  // −1/g [m/N]
  static constexpr scalar feedthrough = 5.0;  // b∞ [N·s/m]
  static constexpr scalar contact_damping = 5.0;  // b while the tool touches [N·s/m]
  static constexpr scalar half_static_stiffness = 250.0;  // ½ k0 [N/m]

  scalar sampled_brake_ = 0;  // b, at this sample [N·s/m]
  scalar sampled_surface_now_ = 0;  // s, at this sample [m]
  scalar surface_ = 0;  // s, how far the surface is pushed in [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
