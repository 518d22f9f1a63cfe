// Needle pushed into liver: shaft friction with presliding and drag, beside the shear of the tissue
//
// source: Form of the friction, presliding with Coulomb and viscous terms: Kim & Lee 2016, porcine tissue, from
//   the abstract; its values are orders of magnitude for forces of a few newtons, not printed. Shear of the
//   tissue: Asbach et al. 2008, Magn Reson Med 60:373, normal liver, from the abstract: mu1 1.16 kPa, mu2 1.97
//   kPa, eta 7.3 Pa s; at a shaft of radius a = 0.6 mm, l = 30 mm deep, in tissue of radius R = 20 mm: f = 2 pi G
//   l u / ln(R/a), so 0.05375 m times each. The needle pushes and is not drawn out: the contact lets it go
// valid: displacement 0 to 0.03 m, rate 0 to 0.02 m/s
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly, except in
//   samples in which a slip or a contact changes
// brake: makes b = 5 N·s/m of damping and, in the parts with slips, what the next lines give, and the motor the
//   rest of the force; by the rule 'faithful': without a device 'faithful' is the paper's rule: in series, B2
//   dissipates 100 % of the energy at low frequency, so that the brake makes its 0.392 N s/m; with the contact no
//   more than the feedthrough damping, so that the motor compensates nothing
// slip rule of friction: velocity-free, while slips slide, no damper acts beyond those at the tool; b = 0 N·s/m
//   stuck, 0 sliding
// states: what the law remembers follows the measured position (position driven, as a network with a contact
//   always is)
// contact: at 0 m; brake and motor 0 while the tool is free
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: not certified: the brake leaves a free tool alone, so that in the sample of the touch only the
//   device's own damping acts; 10.5838 N·s/m of damping are needed, 0 is guaranteed
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion no part gives out more work than it has stored, and slips and contacts only dissipate
//   energy; rounding changes the force by at most 9.5e-15 of the sum of its terms' magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 7 additions, 3 multiplications, 1 guard against subnormal numbers
//   and at most 61 additions, multiplications and divisions for the coupled slips
// cost of update(): 2 additions, 3 multiplications, 2 guards against subnormal numbers; 7 numbers kept between
//   samples
// rounding: the force of a mode is off by at most 1.6e-15 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// 04a5eed649deccadd8600587906cac37a240dd7aaf4c91c8a82b95348dcce7e3. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/slip_tree.hpp>

namespace dashpot::generated {

class needle_in_liver {
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
    B2_K2_force_ = 0;
    presliding_spring_force_ = 0;
    sampled_brake_ = 0;
    sampled_presliding_elongation_ = 0;
    sampled_surface_change_ = 0;
    sampled_surface_now_ = 0;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s].
  // After a non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    // Δ = u − s₋
    const scalar approach = position - surface_;
    // k0 s₋ + S
    const scalar held_force = static_stiffness * surface_ + B2_K2_force_;
    // slip_tree: f, and δ of every block
    const scalar coupled_friction_held[2] = {held_force, presliding_spring_force_};
    scalar coupled_friction_elongation[2] = {};
    int coupled_friction_sign[1] = {};
    dashpot::slip_tree_scratch<scalar, 5, 1, 12> coupled_friction_scratch;
    scalar coupled_friction_change = 0;
    const scalar coupled_friction_force = dashpot::slip_tree<scalar>(coupled_friction,
        coupled_friction_scratch).push(approach, coupled_friction_held, coupled_friction_elongation,
        coupled_friction_sign, coupled_friction_change);
    const scalar surface_change = coupled_friction_change;
    const scalar presliding_elongation = coupled_friction_elongation[1];
    // gap = s − u
    const scalar gap = surface_change - approach;
    // s = s₋ + Δs
    const scalar surface_now = gap > 0 ? dashpot::flush_below(threshold, surface_ + surface_change) : position;
    // f′ = f − b∞ Δs/h
    const scalar opposing = coupled_friction_force + feedthrough_stiffness * surface_change;
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
    sampled_presliding_elongation_ = presliding_elongation;
    sampled_surface_change_ = surface_change;
    sampled_surface_now_ = surface_now;
    return {brake, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // F ← F + k δ
    presliding_spring_force_ = dashpot::flush_below(threshold, presliding_spring_force_ +
        presliding_stiffness * sampled_presliding_elongation_);
    // F ← a (F + c Δu)
    B2_K2_force_ = dashpot::relaxed(threshold, B2_K2_decay, B2_K2_force_, B2_K2_gain * sampled_surface_change_);
    // s₋ = s
    surface_ = sampled_surface_now_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    const dashpot::command<scalar> now = output(position, velocity);
    update();
    return now;
  }

  // No parameter of this network can be set while it runs.
  unsigned set(const parameters&) noexcept { return 0; }

  // Energy in the springs after the last update() [J].
  scalar stored_energy() const noexcept {
    // F²/(2k)
    const scalar B2_K2_energy = B2_K2_energy_weight * B2_K2_force_ * B2_K2_force_;
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = half_static_stiffness * surface_ * surface_ + B2_K2_energy +
        presliding_compliance * presliding_spring_force_ * presliding_spring_force_;
    return stored;
  }

 private:
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar static_stiffness = 62.4;  // k0 [N/m]
  static constexpr scalar none = 0.0;  // no force on a free tool [N]
  static constexpr scalar feedthrough_stiffness = -5000.0;  // −b∞/h [N/m]
  static constexpr scalar feedthrough = 5.0;  // b∞ [N·s/m]
  static constexpr scalar contact_damping = 5.0;  // b while the tool touches [N·s/m]
  static constexpr scalar presliding_stiffness = 1000.0;  // k0 [N/m]
  static constexpr scalar B2_K2_gain = 70.83156667275513;  // a c [N/m]
  static constexpr scalar B2_K2_decay = 0.7632626594783709;  // a = e^{−λh} [1]
  static constexpr scalar half_static_stiffness = 31.2;  // ½ k0 [N/m]
  static constexpr scalar B2_K2_energy_weight = 0.008104495990653925;  // 1/(2 k a²) [m/N]
  static constexpr scalar presliding_compliance = 0.0005;  // 1/(2 k) [m/N]
  // kind, children, slips, place, first corner, stiffness, compliance, yield force
  static constexpr dashpot::slip_node<scalar> coupled_friction[5] = {
      {dashpot::slip_part::parallel, 1, 2, 1, 0, 0, 5155.201037484479, 0.00019397885605795074, 0.0},
      {dashpot::slip_part::block, 0, 0, 0, 0, 0, 5155.201037484479, 0.00019397885605795074, 0.0},
      {dashpot::slip_part::series, 3, 2, 1, 0, 4, 0.0, 0.0, 0.0},
      {dashpot::slip_part::block, 0, 0, 0, 1, 0, 1000.0, 0.001, 0.0},
      {dashpot::slip_part::slip, 0, 0, 1, 0, 8, 0.0, 0.0, 1.5},
  };

  scalar B2_K2_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar presliding_spring_force_ = 0;  // force of the spring [N]
  scalar sampled_brake_ = 0;  // b, at this sample [N·s/m]
  scalar sampled_presliding_elongation_ = 0;  // δ of the block, at this sample [m]
  scalar sampled_surface_change_ = 0;  // Δs since the sample before, at this sample [m]
  scalar sampled_surface_now_ = 0;  // s, at this sample [m]
  scalar surface_ = 0;  // s, how far the surface is pushed in [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
