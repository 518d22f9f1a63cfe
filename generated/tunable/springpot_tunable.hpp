// Tissue that relaxes as a power of time: a springpot whose stiffness changes while it runs, beside a spring
//
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly
// brake: makes b = 1625.577561857746 N·s/m of damping, and the motor the rest of the force; by the rule 'paper':
//   in series, muscle_damper_1 dissipates 100 % of the energy at low frequency, so that the brake makes its
//   1515.38 N s/m; in series, muscle_damper_2 dissipates 100 % of the energy at low frequency, so that the brake
//   makes its 82.3678 N s/m; in series, muscle_damper_3 dissipates 100 % of the energy at low frequency, so that
//   the brake makes its 20.8013 N s/m; in series, muscle_damper_4 dissipates 100 % of the energy at low frequency,
//   so that the brake makes its 5.25321 N s/m; and 1 more series connections likewise
// states: what the law remembers follows the measured position (position driven, so that a change of parameters
//   injects no energy)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: not certified: to be passive for any motion, any values within their ranges between changes, any
//   brake that makes at least the commanded damping, the law needs 1.78601 N·s/m by a proof sample by sample, for
//   commands that are held for up to 0.001 s; 0 N·s/m is guaranteed; the brake's command would have to be 1.78601
//   N·s/m larger
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion, and for any values within their ranges, the law gives out no more work than
//   stored_energy() decreases by; rounding changes the force by at most 6.9e-15 of the sum of its terms'
//   magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// tunable: K (0 to 400 N/m)
//   set() itself injects no energy: raising a stiffness under load raises the force only as far as energy that
//   other springs release allows; but the motor still holds the force of the last sample, so call set() right
//   after step() and take the command from output() of the same sample
//   b [N·s/m] after set(): muscle_damper_1 + muscle_damper_2 + muscle_damper_3 + muscle_damper_4 + muscle_damper_5
// cost of output(): 3 additions, 2 multiplications, 0 guards against subnormal numbers
// cost of update(): 27 additions, 30 multiplications, 6 guards against subnormal numbers; 13 numbers kept between
//   samples
// cost of set(): 355 operations for the constants, 338 for the forces of springs and their energy
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved
//
// Written by dashpot 0.1.0 from a network with digest
// ad65d63c24093f1299b3ee1f326d3cb11e6151cf24830b048ab36de99b135cf8. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/exponential.hpp>
#include <dashpot/elementary.hpp>
#include <dashpot/tunable_range.hpp>

namespace dashpot::generated {

class springpot_tunable {
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
    scalar K = 120.0;  // 0 to 400 [N/m]
  };

  // Starts at rest at `position` [m]: only the springs that hold a force at rest are loaded, from 0. A
  // NaN or infinite position counts as 0.
  void reset(scalar position = 0) noexcept {
    muscle_spring_1_muscle_damper_1_elongation_ = 0;
    muscle_spring_2_muscle_damper_2_elongation_ = 0;
    muscle_spring_3_muscle_damper_3_elongation_ = 0;
    muscle_spring_4_muscle_damper_4_elongation_ = 0;
    muscle_spring_5_muscle_damper_5_elongation_ = 0;
    rest_offset_ = 0;
    tank_ = 0;
    last_position_ = dashpot::all_finite(position, position, position) ? position : 0;
    sampled_position_ = 0;
    sampled_position_change_ = 0;
    // z = u
    rest_elongation_ = last_position_;
    // force if the tool stays
    held_force_ = rest * (rest_elongation_ - rest_offset_) +
        (muscle_spring_1_ * muscle_spring_1_muscle_damper_1_elongation_ - muscle_spring_1_ *
        (muscle_spring_1_muscle_damper_1_loss_ * muscle_spring_1_muscle_damper_1_elongation_)) +
        (muscle_spring_2_ * muscle_spring_2_muscle_damper_2_elongation_ - muscle_spring_2_ *
        (muscle_spring_2_muscle_damper_2_loss_ * muscle_spring_2_muscle_damper_2_elongation_)) +
        (muscle_spring_3_ * muscle_spring_3_muscle_damper_3_elongation_ - muscle_spring_3_ *
        (muscle_spring_3_muscle_damper_3_loss_ * muscle_spring_3_muscle_damper_3_elongation_)) +
        (muscle_spring_4_ * muscle_spring_4_muscle_damper_4_elongation_ - muscle_spring_4_ *
        (muscle_spring_4_muscle_damper_4_loss_ * muscle_spring_4_muscle_damper_4_elongation_)) +
        (muscle_spring_5_ * muscle_spring_5_muscle_damper_5_elongation_ - muscle_spring_5_ *
        (muscle_spring_5_muscle_damper_5_loss_ * muscle_spring_5_muscle_damper_5_elongation_));
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
    sampled_ = false;
    if (!dashpot::all_finite(force)) return {last_brake_, 0};
    sampled_ = true;
    last_brake_ = brake;
    sampled_position_ = position;
    sampled_position_change_ = position_change;
    return {brake, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // z ← z + φ δ − α z
    muscle_spring_1_muscle_damper_1_elongation_ = dashpot::flush_below(threshold,
        muscle_spring_1_muscle_damper_1_elongation_ +
        (muscle_spring_1_muscle_damper_1_kept_ * sampled_position_change_ - muscle_spring_1_muscle_damper_1_loss_ *
        muscle_spring_1_muscle_damper_1_elongation_));
    // z ← z + φ δ − α z
    muscle_spring_2_muscle_damper_2_elongation_ = dashpot::flush_below(threshold,
        muscle_spring_2_muscle_damper_2_elongation_ +
        (muscle_spring_2_muscle_damper_2_kept_ * sampled_position_change_ - muscle_spring_2_muscle_damper_2_loss_ *
        muscle_spring_2_muscle_damper_2_elongation_));
    // z ← z + φ δ − α z
    muscle_spring_3_muscle_damper_3_elongation_ = dashpot::flush_below(threshold,
        muscle_spring_3_muscle_damper_3_elongation_ +
        (muscle_spring_3_muscle_damper_3_kept_ * sampled_position_change_ - muscle_spring_3_muscle_damper_3_loss_ *
        muscle_spring_3_muscle_damper_3_elongation_));
    // z ← z + φ δ − α z
    muscle_spring_4_muscle_damper_4_elongation_ = dashpot::flush_below(threshold,
        muscle_spring_4_muscle_damper_4_elongation_ +
        (muscle_spring_4_muscle_damper_4_kept_ * sampled_position_change_ - muscle_spring_4_muscle_damper_4_loss_ *
        muscle_spring_4_muscle_damper_4_elongation_));
    // z ← z + φ δ − α z
    muscle_spring_5_muscle_damper_5_elongation_ = dashpot::flush_below(threshold,
        muscle_spring_5_muscle_damper_5_elongation_ +
        (muscle_spring_5_muscle_damper_5_kept_ * sampled_position_change_ - muscle_spring_5_muscle_damper_5_loss_ *
        muscle_spring_5_muscle_damper_5_elongation_));
    // z = u
    rest_elongation_ = sampled_position_;
    const scalar rest_offset_after = dashpot::flush_below(threshold, retention * rest_offset_);
    const scalar rest_offset_cost = rest * (rest_offset_ - rest_offset_after) *
        (rest_elongation_ - rest_offset_after + (rest_elongation_ - rest_offset_)) * half;
    const scalar rest_offset_unpaid = rest_offset_cost - tank_;
    tank_ = rest_offset_unpaid > 0 ? tank_ : tank_ - rest_offset_cost;
    // r moves towards 0 if the tank has the energy for it
    rest_offset_ = rest_offset_unpaid > 0 ? rest_offset_ : rest_offset_after;
    // force if the tool stays
    held_force_ = rest * (rest_elongation_ - rest_offset_) +
        (muscle_spring_1_ * muscle_spring_1_muscle_damper_1_elongation_ - muscle_spring_1_ *
        (muscle_spring_1_muscle_damper_1_loss_ * muscle_spring_1_muscle_damper_1_elongation_)) +
        (muscle_spring_2_ * muscle_spring_2_muscle_damper_2_elongation_ - muscle_spring_2_ *
        (muscle_spring_2_muscle_damper_2_loss_ * muscle_spring_2_muscle_damper_2_elongation_)) +
        (muscle_spring_3_ * muscle_spring_3_muscle_damper_3_elongation_ - muscle_spring_3_ *
        (muscle_spring_3_muscle_damper_3_loss_ * muscle_spring_3_muscle_damper_3_elongation_)) +
        (muscle_spring_4_ * muscle_spring_4_muscle_damper_4_elongation_ - muscle_spring_4_ *
        (muscle_spring_4_muscle_damper_4_loss_ * muscle_spring_4_muscle_damper_4_elongation_)) +
        (muscle_spring_5_ * muscle_spring_5_muscle_damper_5_elongation_ - muscle_spring_5_ *
        (muscle_spring_5_muscle_damper_5_loss_ * muscle_spring_5_muscle_damper_5_elongation_));
    // u₋ = u
    last_position_ = sampled_position_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    // m = f − b u̇
    const scalar force = step_stiffness_ * position_change + held_force_ + velocity_gain_ * velocity;
    // b
    const scalar brake = steady_brake_;
    if (!dashpot::all_finite(force)) {
      sampled_ = false;
      return {last_brake_, 0};
    }
    last_brake_ = brake;
    // z ← z + φ δ − α z
    muscle_spring_1_muscle_damper_1_elongation_ = dashpot::flush_below(threshold,
        muscle_spring_1_muscle_damper_1_elongation_ +
        (muscle_spring_1_muscle_damper_1_kept_ * position_change - muscle_spring_1_muscle_damper_1_loss_ *
        muscle_spring_1_muscle_damper_1_elongation_));
    // z ← z + φ δ − α z
    muscle_spring_2_muscle_damper_2_elongation_ = dashpot::flush_below(threshold,
        muscle_spring_2_muscle_damper_2_elongation_ +
        (muscle_spring_2_muscle_damper_2_kept_ * position_change - muscle_spring_2_muscle_damper_2_loss_ *
        muscle_spring_2_muscle_damper_2_elongation_));
    // z ← z + φ δ − α z
    muscle_spring_3_muscle_damper_3_elongation_ = dashpot::flush_below(threshold,
        muscle_spring_3_muscle_damper_3_elongation_ +
        (muscle_spring_3_muscle_damper_3_kept_ * position_change - muscle_spring_3_muscle_damper_3_loss_ *
        muscle_spring_3_muscle_damper_3_elongation_));
    // z ← z + φ δ − α z
    muscle_spring_4_muscle_damper_4_elongation_ = dashpot::flush_below(threshold,
        muscle_spring_4_muscle_damper_4_elongation_ +
        (muscle_spring_4_muscle_damper_4_kept_ * position_change - muscle_spring_4_muscle_damper_4_loss_ *
        muscle_spring_4_muscle_damper_4_elongation_));
    // z ← z + φ δ − α z
    muscle_spring_5_muscle_damper_5_elongation_ = dashpot::flush_below(threshold,
        muscle_spring_5_muscle_damper_5_elongation_ +
        (muscle_spring_5_muscle_damper_5_kept_ * position_change - muscle_spring_5_muscle_damper_5_loss_ *
        muscle_spring_5_muscle_damper_5_elongation_));
    // z = u
    rest_elongation_ = position;
    const scalar rest_offset_after = dashpot::flush_below(threshold, retention * rest_offset_);
    const scalar rest_offset_cost = rest * (rest_offset_ - rest_offset_after) *
        (rest_elongation_ - rest_offset_after + (rest_elongation_ - rest_offset_)) * half;
    const scalar rest_offset_unpaid = rest_offset_cost - tank_;
    tank_ = rest_offset_unpaid > 0 ? tank_ : tank_ - rest_offset_cost;
    // r moves towards 0 if the tank has the energy for it
    rest_offset_ = rest_offset_unpaid > 0 ? rest_offset_ : rest_offset_after;
    // force if the tool stays
    held_force_ = rest * (rest_elongation_ - rest_offset_) +
        (muscle_spring_1_ * muscle_spring_1_muscle_damper_1_elongation_ - muscle_spring_1_ *
        (muscle_spring_1_muscle_damper_1_loss_ * muscle_spring_1_muscle_damper_1_elongation_)) +
        (muscle_spring_2_ * muscle_spring_2_muscle_damper_2_elongation_ - muscle_spring_2_ *
        (muscle_spring_2_muscle_damper_2_loss_ * muscle_spring_2_muscle_damper_2_elongation_)) +
        (muscle_spring_3_ * muscle_spring_3_muscle_damper_3_elongation_ - muscle_spring_3_ *
        (muscle_spring_3_muscle_damper_3_loss_ * muscle_spring_3_muscle_damper_3_elongation_)) +
        (muscle_spring_4_ * muscle_spring_4_muscle_damper_4_elongation_ - muscle_spring_4_ *
        (muscle_spring_4_muscle_damper_4_loss_ * muscle_spring_4_muscle_damper_4_elongation_)) +
        (muscle_spring_5_ * muscle_spring_5_muscle_damper_5_elongation_ - muscle_spring_5_ *
        (muscle_spring_5_muscle_damper_5_loss_ * muscle_spring_5_muscle_damper_5_elongation_));
    // u₋ = u
    last_position_ = position;
    sampled_ = false;
    return {brake, force};
  }

  // Call this right after step(), and take the command from output() of the same sample without another update(): in a
  // loop that is not late the motor then holds the old force no longer, and a spring that changes injects no energy. Bit
  // i of the result: parameter i was beyond its range and is now at its bound, or it was NaN and has not changed.
  unsigned set(const parameters& wanted) noexcept {
    update();
    unsigned clamped = 0;
    clamped |= dashpot::take_value(tunables[0], wanted.K, K_) << 0;
    muscle_spring_1_ = muscle_spring_1_share * K_;
    muscle_damper_1_ = muscle_damper_1_share * K_;
    muscle_spring_2_ = muscle_spring_2_share * K_;
    muscle_damper_2_ = muscle_damper_2_share * K_;
    muscle_spring_3_ = muscle_spring_3_share * K_;
    muscle_damper_3_ = muscle_damper_3_share * K_;
    muscle_spring_4_ = muscle_spring_4_share * K_;
    muscle_damper_4_ = muscle_damper_4_share * K_;
    muscle_spring_5_ = muscle_spring_5_share * K_;
    muscle_damper_5_ = muscle_damper_5_share * K_;
    // x = h k/B
    muscle_spring_1_muscle_damper_1_ratio_ = muscle_damper_1_ > 0 ? dashpot::clamp_to(largest_ratio,
        muscle_spring_1_ * period / muscle_damper_1_) : (muscle_spring_1_ > 0 ? largest_ratio : zero);
    // φ = (1 − e^(−x))/x
    muscle_spring_1_muscle_damper_1_kept_ = dashpot::mean_decay(muscle_spring_1_muscle_damper_1_ratio_);
    // α = x φ
    muscle_spring_1_muscle_damper_1_loss_ = muscle_spring_1_muscle_damper_1_ratio_ *
        muscle_spring_1_muscle_damper_1_kept_;
    // x = h k/B
    muscle_spring_2_muscle_damper_2_ratio_ = muscle_damper_2_ > 0 ? dashpot::clamp_to(largest_ratio,
        muscle_spring_2_ * period / muscle_damper_2_) : (muscle_spring_2_ > 0 ? largest_ratio : zero);
    // φ = (1 − e^(−x))/x
    muscle_spring_2_muscle_damper_2_kept_ = dashpot::mean_decay(muscle_spring_2_muscle_damper_2_ratio_);
    // α = x φ
    muscle_spring_2_muscle_damper_2_loss_ = muscle_spring_2_muscle_damper_2_ratio_ *
        muscle_spring_2_muscle_damper_2_kept_;
    // x = h k/B
    muscle_spring_3_muscle_damper_3_ratio_ = muscle_damper_3_ > 0 ? dashpot::clamp_to(largest_ratio,
        muscle_spring_3_ * period / muscle_damper_3_) : (muscle_spring_3_ > 0 ? largest_ratio : zero);
    // φ = (1 − e^(−x))/x
    muscle_spring_3_muscle_damper_3_kept_ = dashpot::mean_decay(muscle_spring_3_muscle_damper_3_ratio_);
    // α = x φ
    muscle_spring_3_muscle_damper_3_loss_ = muscle_spring_3_muscle_damper_3_ratio_ *
        muscle_spring_3_muscle_damper_3_kept_;
    // x = h k/B
    muscle_spring_4_muscle_damper_4_ratio_ = muscle_damper_4_ > 0 ? dashpot::clamp_to(largest_ratio,
        muscle_spring_4_ * period / muscle_damper_4_) : (muscle_spring_4_ > 0 ? largest_ratio : zero);
    // φ = (1 − e^(−x))/x
    muscle_spring_4_muscle_damper_4_kept_ = dashpot::mean_decay(muscle_spring_4_muscle_damper_4_ratio_);
    // α = x φ
    muscle_spring_4_muscle_damper_4_loss_ = muscle_spring_4_muscle_damper_4_ratio_ *
        muscle_spring_4_muscle_damper_4_kept_;
    // x = h k/B
    muscle_spring_5_muscle_damper_5_ratio_ = muscle_damper_5_ > 0 ? dashpot::clamp_to(largest_ratio,
        muscle_spring_5_ * period / muscle_damper_5_) : (muscle_spring_5_ > 0 ? largest_ratio : zero);
    // φ = (1 − e^(−x))/x
    muscle_spring_5_muscle_damper_5_kept_ = dashpot::mean_decay(muscle_spring_5_muscle_damper_5_ratio_);
    // α = x φ
    muscle_spring_5_muscle_damper_5_loss_ = muscle_spring_5_muscle_damper_5_ratio_ *
        muscle_spring_5_muscle_damper_5_kept_;
    // g of all that joins tool and ground without a slip
    step_stiffness_ = rest + muscle_spring_1_ * muscle_spring_1_muscle_damper_1_kept_ +
        muscle_spring_2_ * muscle_spring_2_muscle_damper_2_kept_ +
        muscle_spring_3_ * muscle_spring_3_muscle_damper_3_kept_ +
        muscle_spring_4_ * muscle_spring_4_muscle_damper_4_kept_ +
        muscle_spring_5_ * muscle_spring_5_muscle_damper_5_kept_;
    muscle_damper_1_to_muscle_damper_5_sum_ = muscle_damper_1_to_muscle_damper_5_share * K_ +
        muscle_damper_1_to_muscle_damper_5_share_2 * K_ + muscle_damper_1_to_muscle_damper_5_share_3 * K_ +
        muscle_damper_1_to_muscle_damper_5_share_4 * K_ + muscle_damper_1_to_muscle_damper_5_share_5 * K_;
    // b: muscle_damper_1 + muscle_damper_2 + muscle_damper_3 + muscle_damper_4 + muscle_damper_5
    steady_brake_ = muscle_damper_1_to_muscle_damper_5_sum_;
    // b∞ − b
    velocity_gain_ = no_damping - steady_brake_;
    const scalar rest_force_before = rest * (rest_elongation_ - rest_offset_);
    const scalar muscle_spring_1_muscle_damper_1_force_before = muscle_spring_1_muscle_damper_1_carried_stiffness_ *
        muscle_spring_1_muscle_damper_1_elongation_;
    const scalar muscle_spring_2_muscle_damper_2_force_before = muscle_spring_2_muscle_damper_2_carried_stiffness_ *
        muscle_spring_2_muscle_damper_2_elongation_;
    const scalar muscle_spring_3_muscle_damper_3_force_before = muscle_spring_3_muscle_damper_3_carried_stiffness_ *
        muscle_spring_3_muscle_damper_3_elongation_;
    const scalar muscle_spring_4_muscle_damper_4_force_before = muscle_spring_4_muscle_damper_4_carried_stiffness_ *
        muscle_spring_4_muscle_damper_4_elongation_;
    const scalar muscle_spring_5_muscle_damper_5_force_before = muscle_spring_5_muscle_damper_5_carried_stiffness_ *
        muscle_spring_5_muscle_damper_5_elongation_;
    // F, or F √(k′/k) where the new stiffness k′ is lower
    const scalar muscle_spring_1_muscle_damper_1_force_kept = muscle_spring_1_muscle_damper_1_carried_stiffness_ -
        muscle_spring_1_ > 0 ? (muscle_spring_1_ > 0 ? muscle_spring_1_muscle_damper_1_force_before *
        dashpot::square_root(muscle_spring_1_ / muscle_spring_1_muscle_damper_1_carried_stiffness_) : zero) :
        muscle_spring_1_muscle_damper_1_force_before;
    const scalar muscle_spring_1_muscle_damper_1_energy_before =
        muscle_spring_1_muscle_damper_1_carried_stiffness_ > 0 ? muscle_spring_1_muscle_damper_1_force_before *
        (muscle_spring_1_muscle_damper_1_force_before / muscle_spring_1_muscle_damper_1_carried_stiffness_) / two :
        zero;
    const scalar muscle_spring_1_muscle_damper_1_energy_after = muscle_spring_1_ > 0 ?
        muscle_spring_1_muscle_damper_1_force_before *
        (muscle_spring_1_muscle_damper_1_force_before / muscle_spring_1_) / two : zero;
    tank_ = tank_ + (muscle_spring_1_ - muscle_spring_1_muscle_damper_1_carried_stiffness_ > 0 ?
        muscle_spring_1_muscle_damper_1_energy_before - muscle_spring_1_muscle_damper_1_energy_after : zero) +
        (muscle_spring_1_ > 0 ? zero : muscle_spring_1_muscle_damper_1_energy_before);
    // F, or F √(k′/k) where the new stiffness k′ is lower
    const scalar muscle_spring_2_muscle_damper_2_force_kept = muscle_spring_2_muscle_damper_2_carried_stiffness_ -
        muscle_spring_2_ > 0 ? (muscle_spring_2_ > 0 ? muscle_spring_2_muscle_damper_2_force_before *
        dashpot::square_root(muscle_spring_2_ / muscle_spring_2_muscle_damper_2_carried_stiffness_) : zero) :
        muscle_spring_2_muscle_damper_2_force_before;
    const scalar muscle_spring_2_muscle_damper_2_energy_before =
        muscle_spring_2_muscle_damper_2_carried_stiffness_ > 0 ? muscle_spring_2_muscle_damper_2_force_before *
        (muscle_spring_2_muscle_damper_2_force_before / muscle_spring_2_muscle_damper_2_carried_stiffness_) / two :
        zero;
    const scalar muscle_spring_2_muscle_damper_2_energy_after = muscle_spring_2_ > 0 ?
        muscle_spring_2_muscle_damper_2_force_before *
        (muscle_spring_2_muscle_damper_2_force_before / muscle_spring_2_) / two : zero;
    tank_ = tank_ + (muscle_spring_2_ - muscle_spring_2_muscle_damper_2_carried_stiffness_ > 0 ?
        muscle_spring_2_muscle_damper_2_energy_before - muscle_spring_2_muscle_damper_2_energy_after : zero) +
        (muscle_spring_2_ > 0 ? zero : muscle_spring_2_muscle_damper_2_energy_before);
    // F, or F √(k′/k) where the new stiffness k′ is lower
    const scalar muscle_spring_3_muscle_damper_3_force_kept = muscle_spring_3_muscle_damper_3_carried_stiffness_ -
        muscle_spring_3_ > 0 ? (muscle_spring_3_ > 0 ? muscle_spring_3_muscle_damper_3_force_before *
        dashpot::square_root(muscle_spring_3_ / muscle_spring_3_muscle_damper_3_carried_stiffness_) : zero) :
        muscle_spring_3_muscle_damper_3_force_before;
    const scalar muscle_spring_3_muscle_damper_3_energy_before =
        muscle_spring_3_muscle_damper_3_carried_stiffness_ > 0 ? muscle_spring_3_muscle_damper_3_force_before *
        (muscle_spring_3_muscle_damper_3_force_before / muscle_spring_3_muscle_damper_3_carried_stiffness_) / two :
        zero;
    const scalar muscle_spring_3_muscle_damper_3_energy_after = muscle_spring_3_ > 0 ?
        muscle_spring_3_muscle_damper_3_force_before *
        (muscle_spring_3_muscle_damper_3_force_before / muscle_spring_3_) / two : zero;
    tank_ = tank_ + (muscle_spring_3_ - muscle_spring_3_muscle_damper_3_carried_stiffness_ > 0 ?
        muscle_spring_3_muscle_damper_3_energy_before - muscle_spring_3_muscle_damper_3_energy_after : zero) +
        (muscle_spring_3_ > 0 ? zero : muscle_spring_3_muscle_damper_3_energy_before);
    // F, or F √(k′/k) where the new stiffness k′ is lower
    const scalar muscle_spring_4_muscle_damper_4_force_kept = muscle_spring_4_muscle_damper_4_carried_stiffness_ -
        muscle_spring_4_ > 0 ? (muscle_spring_4_ > 0 ? muscle_spring_4_muscle_damper_4_force_before *
        dashpot::square_root(muscle_spring_4_ / muscle_spring_4_muscle_damper_4_carried_stiffness_) : zero) :
        muscle_spring_4_muscle_damper_4_force_before;
    const scalar muscle_spring_4_muscle_damper_4_energy_before =
        muscle_spring_4_muscle_damper_4_carried_stiffness_ > 0 ? muscle_spring_4_muscle_damper_4_force_before *
        (muscle_spring_4_muscle_damper_4_force_before / muscle_spring_4_muscle_damper_4_carried_stiffness_) / two :
        zero;
    const scalar muscle_spring_4_muscle_damper_4_energy_after = muscle_spring_4_ > 0 ?
        muscle_spring_4_muscle_damper_4_force_before *
        (muscle_spring_4_muscle_damper_4_force_before / muscle_spring_4_) / two : zero;
    tank_ = tank_ + (muscle_spring_4_ - muscle_spring_4_muscle_damper_4_carried_stiffness_ > 0 ?
        muscle_spring_4_muscle_damper_4_energy_before - muscle_spring_4_muscle_damper_4_energy_after : zero) +
        (muscle_spring_4_ > 0 ? zero : muscle_spring_4_muscle_damper_4_energy_before);
    // F, or F √(k′/k) where the new stiffness k′ is lower
    const scalar muscle_spring_5_muscle_damper_5_force_kept = muscle_spring_5_muscle_damper_5_carried_stiffness_ -
        muscle_spring_5_ > 0 ? (muscle_spring_5_ > 0 ? muscle_spring_5_muscle_damper_5_force_before *
        dashpot::square_root(muscle_spring_5_ / muscle_spring_5_muscle_damper_5_carried_stiffness_) : zero) :
        muscle_spring_5_muscle_damper_5_force_before;
    const scalar muscle_spring_5_muscle_damper_5_energy_before =
        muscle_spring_5_muscle_damper_5_carried_stiffness_ > 0 ? muscle_spring_5_muscle_damper_5_force_before *
        (muscle_spring_5_muscle_damper_5_force_before / muscle_spring_5_muscle_damper_5_carried_stiffness_) / two :
        zero;
    const scalar muscle_spring_5_muscle_damper_5_energy_after = muscle_spring_5_ > 0 ?
        muscle_spring_5_muscle_damper_5_force_before *
        (muscle_spring_5_muscle_damper_5_force_before / muscle_spring_5_) / two : zero;
    tank_ = tank_ + (muscle_spring_5_ - muscle_spring_5_muscle_damper_5_carried_stiffness_ > 0 ?
        muscle_spring_5_muscle_damper_5_energy_before - muscle_spring_5_muscle_damper_5_energy_after : zero) +
        (muscle_spring_5_ > 0 ? zero : muscle_spring_5_muscle_damper_5_energy_before);
    const scalar muscle_spring_1_muscle_damper_1_energy_held = muscle_spring_1_ > 0 ?
        muscle_spring_1_muscle_damper_1_force_kept *
        (muscle_spring_1_muscle_damper_1_force_kept / muscle_spring_1_) / two : zero;
    const scalar muscle_spring_1_muscle_damper_1_energy_missing = muscle_spring_1_muscle_damper_1_energy_after -
        muscle_spring_1_muscle_damper_1_energy_held;
    const scalar muscle_spring_1_muscle_damper_1_force_most = dashpot::square_root(two * muscle_spring_1_ *
        (muscle_spring_1_muscle_damper_1_energy_held + tank_));
    const scalar muscle_spring_1_muscle_damper_1_force_short = muscle_spring_1_muscle_damper_1_force_kept -
        muscle_spring_1_muscle_damper_1_force_before;
    const scalar muscle_spring_1_muscle_damper_1_force_short_size =
        muscle_spring_1_muscle_damper_1_force_short > 0 ? muscle_spring_1_muscle_damper_1_force_short :
        zero - muscle_spring_1_muscle_damper_1_force_short;
    const scalar muscle_spring_1_muscle_damper_1_falls_short = muscle_spring_1_ > 0 ?
        muscle_spring_1_muscle_damper_1_force_short_size : zero;
    const scalar muscle_spring_1_muscle_damper_1_energy_unpaid = muscle_spring_1_muscle_damper_1_energy_missing -
        tank_;
    // F as before, as far as the energy in the tank allows
    const scalar muscle_spring_1_muscle_damper_1_force_after = muscle_spring_1_muscle_damper_1_falls_short > 0 ?
        (muscle_spring_1_muscle_damper_1_energy_unpaid > 0 ? (muscle_spring_1_muscle_damper_1_force_before > 0 ?
        muscle_spring_1_muscle_damper_1_force_most : minus_one *
        muscle_spring_1_muscle_damper_1_force_most) : muscle_spring_1_muscle_damper_1_force_before) :
        muscle_spring_1_muscle_damper_1_force_kept;
    tank_ = muscle_spring_1_muscle_damper_1_falls_short > 0 ? (muscle_spring_1_muscle_damper_1_energy_unpaid > 0 ?
        zero : tank_ - muscle_spring_1_muscle_damper_1_energy_missing) : tank_;
    const scalar muscle_spring_2_muscle_damper_2_energy_held = muscle_spring_2_ > 0 ?
        muscle_spring_2_muscle_damper_2_force_kept *
        (muscle_spring_2_muscle_damper_2_force_kept / muscle_spring_2_) / two : zero;
    const scalar muscle_spring_2_muscle_damper_2_energy_missing = muscle_spring_2_muscle_damper_2_energy_after -
        muscle_spring_2_muscle_damper_2_energy_held;
    const scalar muscle_spring_2_muscle_damper_2_force_most = dashpot::square_root(two * muscle_spring_2_ *
        (muscle_spring_2_muscle_damper_2_energy_held + tank_));
    const scalar muscle_spring_2_muscle_damper_2_force_short = muscle_spring_2_muscle_damper_2_force_kept -
        muscle_spring_2_muscle_damper_2_force_before;
    const scalar muscle_spring_2_muscle_damper_2_force_short_size =
        muscle_spring_2_muscle_damper_2_force_short > 0 ? muscle_spring_2_muscle_damper_2_force_short :
        zero - muscle_spring_2_muscle_damper_2_force_short;
    const scalar muscle_spring_2_muscle_damper_2_falls_short = muscle_spring_2_ > 0 ?
        muscle_spring_2_muscle_damper_2_force_short_size : zero;
    const scalar muscle_spring_2_muscle_damper_2_energy_unpaid = muscle_spring_2_muscle_damper_2_energy_missing -
        tank_;
    // F as before, as far as the energy in the tank allows
    const scalar muscle_spring_2_muscle_damper_2_force_after = muscle_spring_2_muscle_damper_2_falls_short > 0 ?
        (muscle_spring_2_muscle_damper_2_energy_unpaid > 0 ? (muscle_spring_2_muscle_damper_2_force_before > 0 ?
        muscle_spring_2_muscle_damper_2_force_most : minus_one *
        muscle_spring_2_muscle_damper_2_force_most) : muscle_spring_2_muscle_damper_2_force_before) :
        muscle_spring_2_muscle_damper_2_force_kept;
    tank_ = muscle_spring_2_muscle_damper_2_falls_short > 0 ? (muscle_spring_2_muscle_damper_2_energy_unpaid > 0 ?
        zero : tank_ - muscle_spring_2_muscle_damper_2_energy_missing) : tank_;
    const scalar muscle_spring_3_muscle_damper_3_energy_held = muscle_spring_3_ > 0 ?
        muscle_spring_3_muscle_damper_3_force_kept *
        (muscle_spring_3_muscle_damper_3_force_kept / muscle_spring_3_) / two : zero;
    const scalar muscle_spring_3_muscle_damper_3_energy_missing = muscle_spring_3_muscle_damper_3_energy_after -
        muscle_spring_3_muscle_damper_3_energy_held;
    const scalar muscle_spring_3_muscle_damper_3_force_most = dashpot::square_root(two * muscle_spring_3_ *
        (muscle_spring_3_muscle_damper_3_energy_held + tank_));
    const scalar muscle_spring_3_muscle_damper_3_force_short = muscle_spring_3_muscle_damper_3_force_kept -
        muscle_spring_3_muscle_damper_3_force_before;
    const scalar muscle_spring_3_muscle_damper_3_force_short_size =
        muscle_spring_3_muscle_damper_3_force_short > 0 ? muscle_spring_3_muscle_damper_3_force_short :
        zero - muscle_spring_3_muscle_damper_3_force_short;
    const scalar muscle_spring_3_muscle_damper_3_falls_short = muscle_spring_3_ > 0 ?
        muscle_spring_3_muscle_damper_3_force_short_size : zero;
    const scalar muscle_spring_3_muscle_damper_3_energy_unpaid = muscle_spring_3_muscle_damper_3_energy_missing -
        tank_;
    // F as before, as far as the energy in the tank allows
    const scalar muscle_spring_3_muscle_damper_3_force_after = muscle_spring_3_muscle_damper_3_falls_short > 0 ?
        (muscle_spring_3_muscle_damper_3_energy_unpaid > 0 ? (muscle_spring_3_muscle_damper_3_force_before > 0 ?
        muscle_spring_3_muscle_damper_3_force_most : minus_one *
        muscle_spring_3_muscle_damper_3_force_most) : muscle_spring_3_muscle_damper_3_force_before) :
        muscle_spring_3_muscle_damper_3_force_kept;
    tank_ = muscle_spring_3_muscle_damper_3_falls_short > 0 ? (muscle_spring_3_muscle_damper_3_energy_unpaid > 0 ?
        zero : tank_ - muscle_spring_3_muscle_damper_3_energy_missing) : tank_;
    const scalar muscle_spring_4_muscle_damper_4_energy_held = muscle_spring_4_ > 0 ?
        muscle_spring_4_muscle_damper_4_force_kept *
        (muscle_spring_4_muscle_damper_4_force_kept / muscle_spring_4_) / two : zero;
    const scalar muscle_spring_4_muscle_damper_4_energy_missing = muscle_spring_4_muscle_damper_4_energy_after -
        muscle_spring_4_muscle_damper_4_energy_held;
    const scalar muscle_spring_4_muscle_damper_4_force_most = dashpot::square_root(two * muscle_spring_4_ *
        (muscle_spring_4_muscle_damper_4_energy_held + tank_));
    const scalar muscle_spring_4_muscle_damper_4_force_short = muscle_spring_4_muscle_damper_4_force_kept -
        muscle_spring_4_muscle_damper_4_force_before;
    const scalar muscle_spring_4_muscle_damper_4_force_short_size =
        muscle_spring_4_muscle_damper_4_force_short > 0 ? muscle_spring_4_muscle_damper_4_force_short :
        zero - muscle_spring_4_muscle_damper_4_force_short;
    const scalar muscle_spring_4_muscle_damper_4_falls_short = muscle_spring_4_ > 0 ?
        muscle_spring_4_muscle_damper_4_force_short_size : zero;
    const scalar muscle_spring_4_muscle_damper_4_energy_unpaid = muscle_spring_4_muscle_damper_4_energy_missing -
        tank_;
    // F as before, as far as the energy in the tank allows
    const scalar muscle_spring_4_muscle_damper_4_force_after = muscle_spring_4_muscle_damper_4_falls_short > 0 ?
        (muscle_spring_4_muscle_damper_4_energy_unpaid > 0 ? (muscle_spring_4_muscle_damper_4_force_before > 0 ?
        muscle_spring_4_muscle_damper_4_force_most : minus_one *
        muscle_spring_4_muscle_damper_4_force_most) : muscle_spring_4_muscle_damper_4_force_before) :
        muscle_spring_4_muscle_damper_4_force_kept;
    tank_ = muscle_spring_4_muscle_damper_4_falls_short > 0 ? (muscle_spring_4_muscle_damper_4_energy_unpaid > 0 ?
        zero : tank_ - muscle_spring_4_muscle_damper_4_energy_missing) : tank_;
    const scalar muscle_spring_5_muscle_damper_5_energy_held = muscle_spring_5_ > 0 ?
        muscle_spring_5_muscle_damper_5_force_kept *
        (muscle_spring_5_muscle_damper_5_force_kept / muscle_spring_5_) / two : zero;
    const scalar muscle_spring_5_muscle_damper_5_energy_missing = muscle_spring_5_muscle_damper_5_energy_after -
        muscle_spring_5_muscle_damper_5_energy_held;
    const scalar muscle_spring_5_muscle_damper_5_force_most = dashpot::square_root(two * muscle_spring_5_ *
        (muscle_spring_5_muscle_damper_5_energy_held + tank_));
    const scalar muscle_spring_5_muscle_damper_5_force_short = muscle_spring_5_muscle_damper_5_force_kept -
        muscle_spring_5_muscle_damper_5_force_before;
    const scalar muscle_spring_5_muscle_damper_5_force_short_size =
        muscle_spring_5_muscle_damper_5_force_short > 0 ? muscle_spring_5_muscle_damper_5_force_short :
        zero - muscle_spring_5_muscle_damper_5_force_short;
    const scalar muscle_spring_5_muscle_damper_5_falls_short = muscle_spring_5_ > 0 ?
        muscle_spring_5_muscle_damper_5_force_short_size : zero;
    const scalar muscle_spring_5_muscle_damper_5_energy_unpaid = muscle_spring_5_muscle_damper_5_energy_missing -
        tank_;
    // F as before, as far as the energy in the tank allows
    const scalar muscle_spring_5_muscle_damper_5_force_after = muscle_spring_5_muscle_damper_5_falls_short > 0 ?
        (muscle_spring_5_muscle_damper_5_energy_unpaid > 0 ? (muscle_spring_5_muscle_damper_5_force_before > 0 ?
        muscle_spring_5_muscle_damper_5_force_most : minus_one *
        muscle_spring_5_muscle_damper_5_force_most) : muscle_spring_5_muscle_damper_5_force_before) :
        muscle_spring_5_muscle_damper_5_force_kept;
    tank_ = muscle_spring_5_muscle_damper_5_falls_short > 0 ? (muscle_spring_5_muscle_damper_5_energy_unpaid > 0 ?
        zero : tank_ - muscle_spring_5_muscle_damper_5_energy_missing) : tank_;
    const scalar missing_force = rest_force_before - rest_force_before +
        (muscle_spring_1_muscle_damper_1_force_before - muscle_spring_1_muscle_damper_1_force_after) +
        (muscle_spring_2_muscle_damper_2_force_before - muscle_spring_2_muscle_damper_2_force_after) +
        (muscle_spring_3_muscle_damper_3_force_before - muscle_spring_3_muscle_damper_3_force_after) +
        (muscle_spring_4_muscle_damper_4_force_before - muscle_spring_4_muscle_damper_4_force_after) +
        (muscle_spring_5_muscle_damper_5_force_before - muscle_spring_5_muscle_damper_5_force_after);
    const scalar energy_at_hand = (rest > 0 ? rest_force_before * (rest_force_before / rest) / two : zero) + tank_;
    const scalar most_force = dashpot::square_root(two * rest * energy_at_hand);
    const scalar wanted_force = rest_force_before + missing_force;
    const scalar least_force = minus_one * most_force;
    const scalar made_up_force = wanted_force - most_force > 0 ? most_force : (least_force - wanted_force > 0 ?
        least_force : wanted_force);
    const scalar missing_size = missing_force > 0 ? missing_force : zero - missing_force;
    const scalar is_missing = rest > 0 ? missing_size : zero;
    const scalar energy_left = energy_at_hand - (rest > 0 ? made_up_force * (made_up_force / rest) / two : zero);
    // F of the static spring, with what the others have lost
    const scalar rest_force_made_up = is_missing > 0 ? made_up_force : rest_force_before;
    tank_ = is_missing > 0 ? (energy_left > 0 ? energy_left : zero) : tank_;
    const scalar rest_force_change = rest_force_made_up - rest_force_before;
    const scalar rest_force_change_size = rest_force_change > 0 ? rest_force_change : zero - rest_force_change;
    const scalar rest_offset_exact = rest > 0 ? rest_elongation_ - rest_force_made_up / rest : zero;
    const scalar rest_offset_seen = rest_elongation_ + rest_offset_exact * quarter - rest_elongation_;
    const scalar rest_offset_seen_size = rest_offset_seen > 0 ? rest_offset_seen : zero - rest_offset_seen;
    // r = z − F/k
    rest_offset_ = rest_force_change_size > 0 ? (rest_offset_seen_size > 0 ? rest_offset_exact : zero) :
        rest_offset_;
    const scalar muscle_spring_1_muscle_damper_1_force_change = muscle_spring_1_muscle_damper_1_force_after -
        muscle_spring_1_muscle_damper_1_force_before;
    const scalar muscle_spring_1_muscle_damper_1_force_change_size =
        muscle_spring_1_muscle_damper_1_force_change > 0 ? muscle_spring_1_muscle_damper_1_force_change :
        zero - muscle_spring_1_muscle_damper_1_force_change;
    const scalar muscle_spring_1_muscle_damper_1_stiffness_change = muscle_spring_1_ -
        muscle_spring_1_muscle_damper_1_carried_stiffness_;
    const scalar muscle_spring_1_muscle_damper_1_stiffness_change_size =
        muscle_spring_1_muscle_damper_1_stiffness_change > 0 ? muscle_spring_1_muscle_damper_1_stiffness_change :
        zero - muscle_spring_1_muscle_damper_1_stiffness_change;
    const scalar muscle_spring_1_muscle_damper_1_is_changed = muscle_spring_1_muscle_damper_1_force_change_size +
        muscle_spring_1_muscle_damper_1_stiffness_change_size;
    // z = F/k
    muscle_spring_1_muscle_damper_1_elongation_ = muscle_spring_1_muscle_damper_1_is_changed > 0 ?
        (muscle_spring_1_ > 0 ? muscle_spring_1_muscle_damper_1_force_after / muscle_spring_1_ : zero) :
        muscle_spring_1_muscle_damper_1_elongation_;
    const scalar muscle_spring_2_muscle_damper_2_force_change = muscle_spring_2_muscle_damper_2_force_after -
        muscle_spring_2_muscle_damper_2_force_before;
    const scalar muscle_spring_2_muscle_damper_2_force_change_size =
        muscle_spring_2_muscle_damper_2_force_change > 0 ? muscle_spring_2_muscle_damper_2_force_change :
        zero - muscle_spring_2_muscle_damper_2_force_change;
    const scalar muscle_spring_2_muscle_damper_2_stiffness_change = muscle_spring_2_ -
        muscle_spring_2_muscle_damper_2_carried_stiffness_;
    const scalar muscle_spring_2_muscle_damper_2_stiffness_change_size =
        muscle_spring_2_muscle_damper_2_stiffness_change > 0 ? muscle_spring_2_muscle_damper_2_stiffness_change :
        zero - muscle_spring_2_muscle_damper_2_stiffness_change;
    const scalar muscle_spring_2_muscle_damper_2_is_changed = muscle_spring_2_muscle_damper_2_force_change_size +
        muscle_spring_2_muscle_damper_2_stiffness_change_size;
    // z = F/k
    muscle_spring_2_muscle_damper_2_elongation_ = muscle_spring_2_muscle_damper_2_is_changed > 0 ?
        (muscle_spring_2_ > 0 ? muscle_spring_2_muscle_damper_2_force_after / muscle_spring_2_ : zero) :
        muscle_spring_2_muscle_damper_2_elongation_;
    const scalar muscle_spring_3_muscle_damper_3_force_change = muscle_spring_3_muscle_damper_3_force_after -
        muscle_spring_3_muscle_damper_3_force_before;
    const scalar muscle_spring_3_muscle_damper_3_force_change_size =
        muscle_spring_3_muscle_damper_3_force_change > 0 ? muscle_spring_3_muscle_damper_3_force_change :
        zero - muscle_spring_3_muscle_damper_3_force_change;
    const scalar muscle_spring_3_muscle_damper_3_stiffness_change = muscle_spring_3_ -
        muscle_spring_3_muscle_damper_3_carried_stiffness_;
    const scalar muscle_spring_3_muscle_damper_3_stiffness_change_size =
        muscle_spring_3_muscle_damper_3_stiffness_change > 0 ? muscle_spring_3_muscle_damper_3_stiffness_change :
        zero - muscle_spring_3_muscle_damper_3_stiffness_change;
    const scalar muscle_spring_3_muscle_damper_3_is_changed = muscle_spring_3_muscle_damper_3_force_change_size +
        muscle_spring_3_muscle_damper_3_stiffness_change_size;
    // z = F/k
    muscle_spring_3_muscle_damper_3_elongation_ = muscle_spring_3_muscle_damper_3_is_changed > 0 ?
        (muscle_spring_3_ > 0 ? muscle_spring_3_muscle_damper_3_force_after / muscle_spring_3_ : zero) :
        muscle_spring_3_muscle_damper_3_elongation_;
    const scalar muscle_spring_4_muscle_damper_4_force_change = muscle_spring_4_muscle_damper_4_force_after -
        muscle_spring_4_muscle_damper_4_force_before;
    const scalar muscle_spring_4_muscle_damper_4_force_change_size =
        muscle_spring_4_muscle_damper_4_force_change > 0 ? muscle_spring_4_muscle_damper_4_force_change :
        zero - muscle_spring_4_muscle_damper_4_force_change;
    const scalar muscle_spring_4_muscle_damper_4_stiffness_change = muscle_spring_4_ -
        muscle_spring_4_muscle_damper_4_carried_stiffness_;
    const scalar muscle_spring_4_muscle_damper_4_stiffness_change_size =
        muscle_spring_4_muscle_damper_4_stiffness_change > 0 ? muscle_spring_4_muscle_damper_4_stiffness_change :
        zero - muscle_spring_4_muscle_damper_4_stiffness_change;
    const scalar muscle_spring_4_muscle_damper_4_is_changed = muscle_spring_4_muscle_damper_4_force_change_size +
        muscle_spring_4_muscle_damper_4_stiffness_change_size;
    // z = F/k
    muscle_spring_4_muscle_damper_4_elongation_ = muscle_spring_4_muscle_damper_4_is_changed > 0 ?
        (muscle_spring_4_ > 0 ? muscle_spring_4_muscle_damper_4_force_after / muscle_spring_4_ : zero) :
        muscle_spring_4_muscle_damper_4_elongation_;
    const scalar muscle_spring_5_muscle_damper_5_force_change = muscle_spring_5_muscle_damper_5_force_after -
        muscle_spring_5_muscle_damper_5_force_before;
    const scalar muscle_spring_5_muscle_damper_5_force_change_size =
        muscle_spring_5_muscle_damper_5_force_change > 0 ? muscle_spring_5_muscle_damper_5_force_change :
        zero - muscle_spring_5_muscle_damper_5_force_change;
    const scalar muscle_spring_5_muscle_damper_5_stiffness_change = muscle_spring_5_ -
        muscle_spring_5_muscle_damper_5_carried_stiffness_;
    const scalar muscle_spring_5_muscle_damper_5_stiffness_change_size =
        muscle_spring_5_muscle_damper_5_stiffness_change > 0 ? muscle_spring_5_muscle_damper_5_stiffness_change :
        zero - muscle_spring_5_muscle_damper_5_stiffness_change;
    const scalar muscle_spring_5_muscle_damper_5_is_changed = muscle_spring_5_muscle_damper_5_force_change_size +
        muscle_spring_5_muscle_damper_5_stiffness_change_size;
    // z = F/k
    muscle_spring_5_muscle_damper_5_elongation_ = muscle_spring_5_muscle_damper_5_is_changed > 0 ?
        (muscle_spring_5_ > 0 ? muscle_spring_5_muscle_damper_5_force_after / muscle_spring_5_ : zero) :
        muscle_spring_5_muscle_damper_5_elongation_;
    muscle_spring_1_muscle_damper_1_carried_stiffness_ = muscle_spring_1_;
    muscle_spring_2_muscle_damper_2_carried_stiffness_ = muscle_spring_2_;
    muscle_spring_3_muscle_damper_3_carried_stiffness_ = muscle_spring_3_;
    muscle_spring_4_muscle_damper_4_carried_stiffness_ = muscle_spring_4_;
    muscle_spring_5_muscle_damper_5_carried_stiffness_ = muscle_spring_5_;
    // force if the tool stays
    held_force_ = rest * (rest_elongation_ - rest_offset_) +
        (muscle_spring_1_ * muscle_spring_1_muscle_damper_1_elongation_ - muscle_spring_1_ *
        (muscle_spring_1_muscle_damper_1_loss_ * muscle_spring_1_muscle_damper_1_elongation_)) +
        (muscle_spring_2_ * muscle_spring_2_muscle_damper_2_elongation_ - muscle_spring_2_ *
        (muscle_spring_2_muscle_damper_2_loss_ * muscle_spring_2_muscle_damper_2_elongation_)) +
        (muscle_spring_3_ * muscle_spring_3_muscle_damper_3_elongation_ - muscle_spring_3_ *
        (muscle_spring_3_muscle_damper_3_loss_ * muscle_spring_3_muscle_damper_3_elongation_)) +
        (muscle_spring_4_ * muscle_spring_4_muscle_damper_4_elongation_ - muscle_spring_4_ *
        (muscle_spring_4_muscle_damper_4_loss_ * muscle_spring_4_muscle_damper_4_elongation_)) +
        (muscle_spring_5_ * muscle_spring_5_muscle_damper_5_elongation_ - muscle_spring_5_ *
        (muscle_spring_5_muscle_damper_5_loss_ * muscle_spring_5_muscle_damper_5_elongation_));
    return clamped;
  }

  // Energy in the springs, and set free by changes of parameters, after the last update() [J].
  scalar stored_energy() const noexcept {
    // V + tank: in the springs, and set free by changes of parameters
    const scalar stored = tank_ +
        rest * (rest_elongation_ - rest_offset_) * (rest_elongation_ - rest_offset_) * half +
        muscle_spring_1_ * muscle_spring_1_muscle_damper_1_elongation_ *
        muscle_spring_1_muscle_damper_1_elongation_ * half +
        muscle_spring_2_ * muscle_spring_2_muscle_damper_2_elongation_ *
        muscle_spring_2_muscle_damper_2_elongation_ * half +
        muscle_spring_3_ * muscle_spring_3_muscle_damper_3_elongation_ *
        muscle_spring_3_muscle_damper_3_elongation_ * half +
        muscle_spring_4_ * muscle_spring_4_muscle_damper_4_elongation_ *
        muscle_spring_4_muscle_damper_4_elongation_ * half +
        muscle_spring_5_ * muscle_spring_5_muscle_damper_5_elongation_ *
        muscle_spring_5_muscle_damper_5_elongation_ * half;
    return stored;
  }

 private:
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar rest = 40.0;  // as in the network [N/m]
  static constexpr scalar muscle_spring_1_share = 0.5529489387983896;  // factor of K [1]
  static constexpr scalar muscle_damper_1_share = 12.628169563370793;  // factor of K [1]
  static constexpr scalar muscle_spring_2_share = 0.4443552938125914;  // factor of K [1]
  static constexpr scalar muscle_damper_2_share = 0.6863981165441095;  // factor of K [1]
  static constexpr scalar muscle_spring_3_share = 0.8014436491467305;  // factor of K [1]
  static constexpr scalar muscle_damper_3_share = 0.1733444489849207;  // factor of K [1]
  static constexpr scalar muscle_spring_4_share = 1.4454917758412602;  // factor of K [1]
  static constexpr scalar muscle_damper_4_share = 0.043776778038339514;  // factor of K [1]
  static constexpr scalar muscle_spring_5_share = 4.501420953574023;  // factor of K [1]
  static constexpr scalar muscle_damper_5_share = 0.014790775209721498;  // factor of K [1]
  static constexpr scalar largest_ratio = 1.2676506002282294e+30;  // largest x: beyond it nothing is left after a sample [1]
  static constexpr scalar period = 0.001;  // h, the sample period [s]
  static constexpr scalar zero = 0.0;  // zero [1]
  static constexpr scalar no_damping = 0.0;  // zero [N·s/m]
  static constexpr scalar muscle_damper_1_to_muscle_damper_5_share = 12.628169563370793;  // factor of K [1]
  static constexpr scalar muscle_damper_1_to_muscle_damper_5_share_2 = 0.6863981165441095;  // factor of K [1]
  static constexpr scalar muscle_damper_1_to_muscle_damper_5_share_3 = 0.1733444489849207;  // factor of K [1]
  static constexpr scalar muscle_damper_1_to_muscle_damper_5_share_4 = 0.043776778038339514;  // factor of K [1]
  static constexpr scalar muscle_damper_1_to_muscle_damper_5_share_5 = 0.014790775209721498;  // factor of K [1]
  static constexpr scalar two = 2.0;  // two [1]
  static constexpr scalar minus_one = -1.0;  // minus one [1]
  static constexpr scalar quarter = 0.25;  // a quarter [1]
  static constexpr scalar retention = 0.9900498337491681;  // share of r that is left after a sample [1]
  static constexpr scalar half = 0.5;  // a half [1]
  static constexpr dashpot::tunable_range<scalar> tunables[1] = {
      {120.0, 0.0, 400.0},  // K [N/m]
  };

  scalar held_force_ = 0;  // force of the springs if the tool stays [N]
  scalar K_ = 120.0;  // parameter [N/m]
  scalar muscle_spring_1_ = 66.35387265580675;  // the parameter times its factor [N/m]
  scalar muscle_damper_1_ = 1515.3803476044952;  // the parameter times its factor [N s/m]
  scalar muscle_spring_2_ = 53.32263525751097;  // the parameter times its factor [N/m]
  scalar muscle_damper_2_ = 82.36777398529314;  // the parameter times its factor [N s/m]
  scalar muscle_spring_3_ = 96.17323789760766;  // the parameter times its factor [N/m]
  scalar muscle_damper_3_ = 20.801333878190487;  // the parameter times its factor [N s/m]
  scalar muscle_spring_4_ = 173.4590131009512;  // the parameter times its factor [N/m]
  scalar muscle_damper_4_ = 5.253213364600741;  // the parameter times its factor [N s/m]
  scalar muscle_spring_5_ = 540.1705144288827;  // the parameter times its factor [N/m]
  scalar muscle_damper_5_ = 1.7748930251665798;  // the parameter times its factor [N s/m]
  scalar muscle_spring_1_muscle_damper_1_ratio_ = 4.378694283629756e-05;  // x, the sample period over the relaxation time [1]
  scalar muscle_spring_1_muscle_damper_1_kept_ = 0.9999781068481277;  // φ, share of a displacement that is left in the spring at the end of the sample [1]
  scalar muscle_spring_1_muscle_damper_1_loss_ = 4.378598420210802e-05;  // α, share of its elongation that is lost in a sample [1]
  scalar muscle_spring_2_muscle_damper_2_ratio_ = 0.0006473725424099939;  // x, the sample period over the relaxation time [1]
  scalar muscle_spring_2_muscle_damper_2_kept_ = 0.9996763835660267;  // φ, share of a displacement that is left in the spring at the end of the sample [1]
  scalar muscle_spring_2_muscle_damper_2_loss_ = 0.0006471630420163669;  // α, share of its elongation that is lost in a sample [1]
  scalar muscle_spring_3_muscle_damper_3_ratio_ = 0.004623416866475189;  // x, the sample period over the relaxation time [1]
  scalar muscle_spring_3_muscle_damper_3_kept_ = 0.9976918501165674;  // φ, share of a displacement that is left in the spring at the end of the sample [1]
  scalar muscle_spring_3_muscle_damper_3_loss_ = 0.0046127453273737745;  // α, share of its elongation that is lost in a sample [1]
  scalar muscle_spring_4_muscle_damper_4_ratio_ = 0.03301960172983276;  // x, the sample period over the relaxation time [1]
  scalar muscle_spring_4_muscle_damper_4_kept_ = 0.9836704246251956;  // φ, share of a displacement that is left in the spring at the end of the sample [1]
  scalar muscle_spring_4_muscle_damper_4_loss_ = 0.03248040565453943;  // α, share of its elongation that is lost in a sample [1]
  scalar muscle_spring_5_muscle_damper_5_ratio_ = 0.30433975837962735;  // x, the sample period over the relaxation time [1]
  scalar muscle_spring_5_muscle_damper_5_kept_ = 0.862160720557397;  // φ, share of a displacement that is left in the spring at the end of the sample [1]
  scalar muscle_spring_5_muscle_damper_5_loss_ = 0.2623897853788436;  // α, share of its elongation that is lost in a sample [1]
  scalar step_stiffness_ = 891.9493558025447;  // stiffness of the springs over one sample [N/m]
  scalar rest_elongation_ = 0;  // z, elongation of the spring [m]
  scalar muscle_spring_1_muscle_damper_1_elongation_ = 0;  // z, elongation of the spring [m]
  scalar muscle_spring_1_muscle_damper_1_carried_stiffness_ = 66.35387265580675;  // k after the last change of parameters [N/m]
  scalar muscle_spring_2_muscle_damper_2_elongation_ = 0;  // z, elongation of the spring [m]
  scalar muscle_spring_2_muscle_damper_2_carried_stiffness_ = 53.32263525751097;  // k after the last change of parameters [N/m]
  scalar muscle_spring_3_muscle_damper_3_elongation_ = 0;  // z, elongation of the spring [m]
  scalar muscle_spring_3_muscle_damper_3_carried_stiffness_ = 96.17323789760766;  // k after the last change of parameters [N/m]
  scalar muscle_spring_4_muscle_damper_4_elongation_ = 0;  // z, elongation of the spring [m]
  scalar muscle_spring_4_muscle_damper_4_carried_stiffness_ = 173.4590131009512;  // k after the last change of parameters [N/m]
  scalar muscle_spring_5_muscle_damper_5_elongation_ = 0;  // z, elongation of the spring [m]
  scalar muscle_spring_5_muscle_damper_5_carried_stiffness_ = 540.1705144288827;  // k after the last change of parameters [N/m]
  scalar rest_offset_ = 0;  // r, shift of the spring's rest length [m]
  scalar tank_ = 0;  // energy set free by changes of parameters, not yet spent [J]
  scalar muscle_damper_1_to_muscle_damper_5_sum_ = 1625.577561857746;  // sum over these elements [N s/m]
  scalar steady_brake_ = 1625.577561857746;  // b of the parts that no slip changes [N·s/m]
  scalar velocity_gain_ = -1625.577561857746;  // b∞ − b [N·s/m]
  scalar last_brake_ = 1625.577561857746;  // b of the sample before [N·s/m]
  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
