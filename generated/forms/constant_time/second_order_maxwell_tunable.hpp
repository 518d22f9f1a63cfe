// General viscoelastic solid, Fig. 2e, with two values that change while it runs
//
// source: Gosline & Hayward 2009, Fig. 5; the ranges are ours
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly
// brake: makes b = 11 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': in series, B1
//   dissipates 100 % of the energy at low frequency, so that the brake makes its 5 N s/m; in series, damper_3
//   dissipates 100 % of the energy at low frequency, so that the brake makes its 6 N s/m
// states: what the law remembers follows the measured position (position driven, so that a change of parameters
//   injects no energy)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: not certified: to be passive for any motion, any values within their ranges between changes, any
//   brake that makes at least the commanded damping, the law needs 5.5652 N·s/m by a proof sample by sample, for
//   commands that are held for up to 0.001 s; 5.5 N·s/m is guaranteed; the brake's command would have to be 0.0652
//   N·s/m larger
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion, and for any values within their ranges, the law gives out no more work than
//   stored_energy() decreases by; rounding changes the force by at most 3.9e-15 of the sum of its terms'
//   magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// tunable: K1 (0 to 100 N/m), B2 (0.5 to 20 N s/m)
//   set() itself injects no energy: raising a stiffness under load raises the force only as far as energy that
//   other springs release allows; but the motor still holds the force of the last sample, so call set() right
//   after step() and take the command from output() of the same sample
//   b [N·s/m] after set(): B1 + damper_3
// cost of output(): 3 additions, 2 multiplications, 0 guards against subnormal numbers
// cost of update(): 15 additions, 15 multiplications, 3 guards against subnormal numbers; 10 numbers kept between
//   samples
// cost of set(): 132 operations for the constants, 107 for the forces of springs and their energy
// constant time: output() and update() choose by masks, not by jumps
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved
//
// Written by dashpot 0.1.0 from a network with digest
// 5c194d7008f5fe1bb0e1c8f01d1156815ca3b1ae3e5903a351efbfbd8297cdca. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/branch_free.hpp>
#include <dashpot/command.hpp>
#include <dashpot/exponential.hpp>
#include <dashpot/elementary.hpp>
#include <dashpot/tunable_range.hpp>

namespace dashpot::generated {

class second_order_maxwell_tunable {
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

  struct parameters {
    scalar K1 = 12.0;  // 0 to 100 [N/m]
    scalar B2 = 6.0;  // 0.5 to 20 [N s/m]
  };

  // Starts at rest at `position` [m]: only the springs that hold a force at rest are loaded, from 0. A
  // NaN or infinite position counts as 0.
  void reset(scalar position = 0) noexcept {
    B1_spring_2_elongation_ = 0;
    damper_3_K2_elongation_ = 0;
    K3_offset_ = 0;
    tank_ = 0;
    last_position_ = dashpot::all_finite(position, position, position) ? position : 0;
    sampled_position_ = 0;
    sampled_position_change_ = 0;
    // z = u
    K3_elongation_ = last_position_;
    // force if the tool stays
    held_force_ = K3 * (K3_elongation_ - K3_offset_) +
        (K1_ * B1_spring_2_elongation_ - K1_ * (B1_spring_2_loss_ * B1_spring_2_elongation_)) +
        (K2 * damper_3_K2_elongation_ - K2 * (damper_3_K2_loss_ * damper_3_K2_elongation_));
    last_brake_ = steady_brake_;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s].
  // After a non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    // m = f − b u̇
    const scalar force = step_stiffness_ * position_change + held_force_ + velocity_gain_ * velocity;
    // b
    const scalar brake = steady_brake_;
    sampled_ = dashpot::all_finite(position, velocity, force);
    const auto sampled = dashpot::branch_free::mask_of<scalar>(sampled_);
    last_brake_ = dashpot::branch_free::chosen(sampled, brake, last_brake_);
    sampled_position_ = dashpot::branch_free::chosen(sampled, position, sampled_position_);
    sampled_position_change_ = dashpot::branch_free::chosen(sampled, position_change, sampled_position_change_);
    return {last_brake_, dashpot::branch_free::chosen(sampled, force, scalar(0))};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    const auto sampled = dashpot::branch_free::mask_of<scalar>(sampled_);
    sampled_ = false;
    // z ← z + φ δ − α z
    B1_spring_2_elongation_ = dashpot::branch_free::chosen(sampled, dashpot::branch_free::flush_below(threshold,
        B1_spring_2_elongation_ +
        (B1_spring_2_kept_ * sampled_position_change_ - B1_spring_2_loss_ * B1_spring_2_elongation_)),
        B1_spring_2_elongation_);
    // z ← z + φ δ − α z
    damper_3_K2_elongation_ = dashpot::branch_free::chosen(sampled, dashpot::branch_free::flush_below(threshold,
        damper_3_K2_elongation_ +
        (damper_3_K2_kept_ * sampled_position_change_ - damper_3_K2_loss_ * damper_3_K2_elongation_)),
        damper_3_K2_elongation_);
    // z = u
    K3_elongation_ = dashpot::branch_free::chosen(sampled, sampled_position_, K3_elongation_);
    const scalar K3_offset_after = dashpot::branch_free::flush_below(threshold, retention * K3_offset_);
    const scalar K3_offset_cost = K3 * (K3_offset_ - K3_offset_after) * (K3_elongation_ - K3_offset_after +
        (K3_elongation_ - K3_offset_)) * half;
    const scalar K3_offset_unpaid = K3_offset_cost - tank_;
    tank_ = dashpot::branch_free::chosen(sampled, dashpot::branch_free::where(K3_offset_unpaid, tank_,
        tank_ - K3_offset_cost), tank_);
    // r moves towards 0 if the tank has the energy for it
    K3_offset_ = dashpot::branch_free::chosen(sampled, dashpot::branch_free::where(K3_offset_unpaid, K3_offset_,
        K3_offset_after), K3_offset_);
    // force if the tool stays
    held_force_ = dashpot::branch_free::chosen(sampled, K3 * (K3_elongation_ - K3_offset_) +
        (K1_ * B1_spring_2_elongation_ - K1_ * (B1_spring_2_loss_ * B1_spring_2_elongation_)) +
        (K2 * damper_3_K2_elongation_ - K2 * (damper_3_K2_loss_ * damper_3_K2_elongation_)), held_force_);
    // u₋ = u
    last_position_ = dashpot::branch_free::chosen(sampled, sampled_position_, last_position_);
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    const dashpot::command<scalar> now = output(position, velocity);
    update();
    return now;
  }

  // Call this right after step(), and take the command from output() of the same sample without another update(): in a
  // loop that is not late the motor then holds the old force no longer, and a spring that changes injects no energy. Bit
  // i of the result: parameter i was beyond its range and is now at its bound, or it was NaN and has not changed.
  unsigned set(const parameters& wanted) noexcept {
    update();
    unsigned clamped = 0;
    clamped |= dashpot::take_value(tunables[0], wanted.K1, K1_) << 0;
    clamped |= dashpot::take_value(tunables[1], wanted.B2, B2_) << 1;
    // x = h k/B
    B1_spring_2_ratio_ = dashpot::clamp_to(largest_ratio, K1_ * period / B1);
    // φ = (1 − e^(−x))/x
    B1_spring_2_kept_ = dashpot::mean_decay(B1_spring_2_ratio_);
    // α = x φ
    B1_spring_2_loss_ = B1_spring_2_ratio_ * B1_spring_2_kept_;
    // x = h k/B
    damper_3_K2_ratio_ = dashpot::clamp_to(largest_ratio, K2 * period / B2_);
    // φ = (1 − e^(−x))/x
    damper_3_K2_kept_ = dashpot::mean_decay(damper_3_K2_ratio_);
    // α = x φ
    damper_3_K2_loss_ = damper_3_K2_ratio_ * damper_3_K2_kept_;
    // g of all that joins tool and ground without a slip
    step_stiffness_ = K3 + K1_ * B1_spring_2_kept_ + K2 * damper_3_K2_kept_;
    B1_damper_3_sum_ = B1_damper_3 + B2_;
    // b: B1 + damper_3
    steady_brake_ = B1_damper_3_sum_;
    // b∞ − b
    velocity_gain_ = no_damping - steady_brake_;
    const scalar K3_force_before = K3 * (K3_elongation_ - K3_offset_);
    const scalar B1_spring_2_force_before = B1_spring_2_carried_stiffness_ * B1_spring_2_elongation_;
    // F, or F √(k′/k) where the new stiffness k′ is lower
    const scalar B1_spring_2_force_kept = B1_spring_2_carried_stiffness_ - K1_ > 0 ? (K1_ > 0 ?
        B1_spring_2_force_before *
        dashpot::square_root(K1_ / B1_spring_2_carried_stiffness_) : zero) : B1_spring_2_force_before;
    const scalar B1_spring_2_energy_before = B1_spring_2_carried_stiffness_ > 0 ? B1_spring_2_force_before *
        (B1_spring_2_force_before / B1_spring_2_carried_stiffness_) / two : zero;
    const scalar B1_spring_2_energy_after = K1_ > 0 ? B1_spring_2_force_before *
        (B1_spring_2_force_before / K1_) / two : zero;
    tank_ = tank_ + (K1_ - B1_spring_2_carried_stiffness_ > 0 ?
        B1_spring_2_energy_before - B1_spring_2_energy_after : zero) + (K1_ > 0 ? zero : B1_spring_2_energy_before);
    const scalar B1_spring_2_energy_held = K1_ > 0 ? B1_spring_2_force_kept *
        (B1_spring_2_force_kept / K1_) / two : zero;
    const scalar B1_spring_2_energy_missing = B1_spring_2_energy_after - B1_spring_2_energy_held;
    const scalar B1_spring_2_force_most = dashpot::square_root(two * K1_ * (B1_spring_2_energy_held + tank_));
    const scalar B1_spring_2_force_short = B1_spring_2_force_kept - B1_spring_2_force_before;
    const scalar B1_spring_2_force_short_size = B1_spring_2_force_short > 0 ? B1_spring_2_force_short :
        zero - B1_spring_2_force_short;
    const scalar B1_spring_2_falls_short = K1_ > 0 ? B1_spring_2_force_short_size : zero;
    const scalar B1_spring_2_energy_unpaid = B1_spring_2_energy_missing - tank_;
    // F as before, as far as the energy in the tank allows
    const scalar B1_spring_2_force_after = B1_spring_2_falls_short > 0 ? (B1_spring_2_energy_unpaid > 0 ?
        (B1_spring_2_force_before > 0 ? B1_spring_2_force_most : minus_one *
        B1_spring_2_force_most) : B1_spring_2_force_before) : B1_spring_2_force_kept;
    tank_ = B1_spring_2_falls_short > 0 ? (B1_spring_2_energy_unpaid > 0 ? zero :
        tank_ - B1_spring_2_energy_missing) : tank_;
    const scalar missing_force = K3_force_before - K3_force_before +
        (B1_spring_2_force_before - B1_spring_2_force_after);
    const scalar energy_at_hand = (K3 > 0 ? K3_force_before * (K3_force_before / K3) / two : zero) + tank_;
    const scalar most_force = dashpot::square_root(two * K3 * energy_at_hand);
    const scalar wanted_force = K3_force_before + missing_force;
    const scalar least_force = minus_one * most_force;
    const scalar made_up_force = wanted_force - most_force > 0 ? most_force : (least_force - wanted_force > 0 ?
        least_force : wanted_force);
    const scalar missing_size = missing_force > 0 ? missing_force : zero - missing_force;
    const scalar is_missing = K3 > 0 ? missing_size : zero;
    const scalar energy_left = energy_at_hand - (K3 > 0 ? made_up_force * (made_up_force / K3) / two : zero);
    // F of the static spring, with what the others have lost
    const scalar K3_force_made_up = is_missing > 0 ? made_up_force : K3_force_before;
    tank_ = is_missing > 0 ? (energy_left > 0 ? energy_left : zero) : tank_;
    const scalar K3_force_change = K3_force_made_up - K3_force_before;
    const scalar K3_force_change_size = K3_force_change > 0 ? K3_force_change : zero - K3_force_change;
    const scalar K3_offset_exact = K3 > 0 ? K3_elongation_ - K3_force_made_up / K3 : zero;
    const scalar K3_offset_seen = K3_elongation_ + K3_offset_exact * quarter - K3_elongation_;
    const scalar K3_offset_seen_size = K3_offset_seen > 0 ? K3_offset_seen : zero - K3_offset_seen;
    // r = z − F/k
    K3_offset_ = K3_force_change_size > 0 ? (K3_offset_seen_size > 0 ? K3_offset_exact : zero) : K3_offset_;
    const scalar B1_spring_2_force_change = B1_spring_2_force_after - B1_spring_2_force_before;
    const scalar B1_spring_2_force_change_size = B1_spring_2_force_change > 0 ? B1_spring_2_force_change :
        zero - B1_spring_2_force_change;
    const scalar B1_spring_2_stiffness_change = K1_ - B1_spring_2_carried_stiffness_;
    const scalar B1_spring_2_stiffness_change_size = B1_spring_2_stiffness_change > 0 ?
        B1_spring_2_stiffness_change : zero - B1_spring_2_stiffness_change;
    const scalar B1_spring_2_is_changed = B1_spring_2_force_change_size + B1_spring_2_stiffness_change_size;
    // z = F/k
    B1_spring_2_elongation_ = B1_spring_2_is_changed > 0 ? (K1_ > 0 ? B1_spring_2_force_after / K1_ : zero) :
        B1_spring_2_elongation_;
    B1_spring_2_carried_stiffness_ = K1_;
    // force if the tool stays
    held_force_ = K3 * (K3_elongation_ - K3_offset_) +
        (K1_ * B1_spring_2_elongation_ - K1_ * (B1_spring_2_loss_ * B1_spring_2_elongation_)) +
        (K2 * damper_3_K2_elongation_ - K2 * (damper_3_K2_loss_ * damper_3_K2_elongation_));
    return clamped;
  }

  // Energy in the springs, and set free by changes of parameters, after the last update() [J].
  scalar stored_energy() const noexcept {
    // V + tank: in the springs, and set free by changes of parameters
    const scalar stored = tank_ + K3 * (K3_elongation_ - K3_offset_) * (K3_elongation_ - K3_offset_) * half +
        K1_ * B1_spring_2_elongation_ * B1_spring_2_elongation_ * half +
        K2 * damper_3_K2_elongation_ * damper_3_K2_elongation_ * half;
    return stored;
  }

 private:
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar K3 = 5.0;  // as in the network [N/m]
  static constexpr scalar B1 = 5.0;  // as in the network [N s/m]
  static constexpr scalar K2 = 10.0;  // as in the network [N/m]
  static constexpr scalar largest_ratio = 1.2676506002282294e+30;  // largest x: beyond it nothing is left after a sample [1]
  static constexpr scalar period = 0.001;  // h, the sample period [s]
  static constexpr scalar no_damping = 0.0;  // zero [N·s/m]
  static constexpr scalar B1_damper_3 = 5.0;  // sum of the values that do not change [N s/m]
  static constexpr scalar zero = 0.0;  // nothing [1]
  static constexpr scalar two = 2.0;  // two [1]
  static constexpr scalar minus_one = -1.0;  // minus one [1]
  static constexpr scalar quarter = 0.25;  // a quarter [1]
  static constexpr scalar retention = 0.9900498337491681;  // share of r that is left after a sample [1]
  static constexpr scalar half = 0.5;  // a half [1]
  static constexpr dashpot::tunable_range<scalar> tunables[2] = {
      {12.0, 0.0, 100.0},  // K1 [N/m]
      {6.0, 0.5, 20.0},  // B2 [N s/m]
  };

  scalar held_force_ = 0;  // force of the springs if the tool stays [N]
  scalar K1_ = 12.0;  // parameter [N/m]
  scalar B2_ = 6.0;  // parameter [N s/m]
  scalar B1_spring_2_ratio_ = 0.0024000000000000002;  // x, the sample period over the relaxation time [1]
  scalar B1_spring_2_kept_ = 0.9988009594242764;  // φ, share of a displacement that is left in the spring at the end of the sample [1]
  scalar B1_spring_2_loss_ = 0.0023971223026182636;  // α, share of its elongation that is lost in a sample [1]
  scalar damper_3_K2_ratio_ = 0.0016666666666666668;  // x, the sample period over the relaxation time [1]
  scalar damper_3_K2_kept_ = 0.9991671294367926;  // φ, share of a displacement that is left in the spring at the end of the sample [1]
  scalar damper_3_K2_loss_ = 0.0016652785490613212;  // α, share of its elongation that is lost in a sample [1]
  scalar step_stiffness_ = 26.977282807459243;  // stiffness of the springs over one sample [N/m]
  scalar K3_elongation_ = 0;  // z, elongation of the spring [m]
  scalar B1_spring_2_elongation_ = 0;  // z, elongation of the spring [m]
  scalar B1_spring_2_carried_stiffness_ = 12.0;  // k after the last change of parameters [N/m]
  scalar damper_3_K2_elongation_ = 0;  // z, elongation of the spring [m]
  scalar K3_offset_ = 0;  // r, shift of the spring's rest length [m]
  scalar tank_ = 0;  // energy set free by changes of parameters, not yet spent [J]
  scalar B1_damper_3_sum_ = 11.0;  // sum over these elements [N s/m]
  scalar steady_brake_ = 11.0;  // b of the parts that no slip changes [N·s/m]
  scalar velocity_gain_ = -11.0;  // b∞ − b [N·s/m]
  scalar last_brake_ = 11.0;  // b of the sample before [N·s/m]
  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
