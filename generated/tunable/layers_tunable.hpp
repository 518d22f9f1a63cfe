// A needle that sticks in two layers, which slide on each other: a ring of three slips, frictions and stiffness change while it runs
//
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly, except in
//   samples in which a slip or a contact changes
// brake: makes b = 3 N·s/m of damping and, in the parts with slips, what the next lines give, and the motor the
//   rest of the force; by the rule 'faithful': without a device 'faithful' is the paper's rule: dampers at the
//   tool in parallel add
// slip rule of skin_grip, muscle_grip, fascia: velocity-free, parameters change while it runs; b is that of their
//   default values
// states: what the law remembers follows the measured position (position driven, so that a change of parameters
//   injects no energy)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: certified for any motion, whichever slips slide or stick and whether the tool touches or not, any
//   values within their ranges between changes, any brake that makes at least the commanded damping: needs 2 N·s/m
//   by a proof sample by sample, for commands that are held for up to 0.001 s; 3 N·s/m is guaranteed
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion, and for any values within their ranges, the law gives out no more work than
//   stored_energy() decreases by; rounding changes the force by at most 1.3e-12 of the sum of its terms'
//   magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// tunable: skin_friction (0 to 3 N), muscle_friction (0 to 3 N), muscle_stiffness (100 to 4000 N/m)
//   set() itself injects no energy: raising a stiffness under load raises the force only as far as energy that
//   other springs release allows; but the motor still holds the force of the last sample, so call set() right
//   after step() and take the command from output() of the same sample
//   b [N·s/m] after set(): drag
// cost of output(): 7 additions, 4 multiplications, 0 guards against subnormal numbers
//   and at most 11370 additions, multiplications and divisions for the coupled slips
// cost of update(): 8 additions, 8 multiplications, 4 guards against subnormal numbers; 20 numbers kept between
//   samples
// cost of set(): 77 operations for the constants, 60 for the forces of springs and their energy
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved
//
// Written by dashpot 0.1.0 from a network with digest
// f0efa940f84bdf7de39f3046f7db636a23508bba43641aab1bc67b5c837ec98b. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/slip_network.hpp>
#include <dashpot/exponential.hpp>
#include <dashpot/elementary.hpp>
#include <dashpot/tunable_range.hpp>

namespace dashpot::generated {

class layers_tunable {
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

  struct parameters {
    scalar skin_friction = 0.8;  // 0 to 3 [N]
    scalar muscle_friction = 1.2;  // 0 to 3 [N]
    scalar muscle_stiffness = 900.0;  // 100 to 4000 [N/m]
  };

  // Starts at rest at `position` [m]: only the springs that hold a force at rest are loaded, from 0. A
  // NaN or infinite position counts as 0.
  void reset(scalar position = 0) noexcept {
    presliding_elongation_ = 0;
    skin_elasticity_elongation_ = 0;
    muscle_rest_elongation_ = 0;
    muscle_elasticity_muscle_viscosity_elongation_ = 0;
    presliding_held_ = 0;
    skin_elasticity_skin_viscosity_held_ = 0;
    muscle_elasticity_to_muscle_rest_held_ = 0;
    sampled_skin_grip_sign_ = 0;
    sampled_muscle_grip_sign_ = 0;
    sampled_fascia_sign_ = 0;
    tank_ = 0;
    last_position_ = dashpot::all_finite(position, position, position) ? position : 0;
    sampled_position_ = 0;
    sampled_position_change_ = 0;
    sampled_network_skin_grip_end_1_moved_ = 0;
    sampled_network_skin_grip_end_2_moved_ = 0;
    sampled_network_skin_grip_end_3_moved_ = 0;
    // force if the tool stays
    held_force_ = zero;
    // b while all slips hold
    resting_brake_ = zero;
    last_brake_ = steady_brake_ + resting_brake_;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s].
  // After a non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    const scalar network_skin_grip_end_1_held = zero - presliding_held_;
    const scalar network_skin_grip_end_2_held = skin_elasticity_skin_viscosity_held_;
    const scalar network_skin_grip_end_3_held = muscle_elasticity_to_muscle_rest_held_;
    const scalar network_skin_grip_tool_held = presliding_held_;
    // slip_network: f, and how far every end moves
    const scalar network_skin_grip_held[4] = {network_skin_grip_end_1_held, network_skin_grip_end_2_held,
        network_skin_grip_end_3_held, network_skin_grip_tool_held};
    scalar network_skin_grip_moved[3] = {};
    int network_skin_grip_sign[3] = {static_cast<int>(sampled_skin_grip_sign_),
        static_cast<int>(sampled_muscle_grip_sign_), static_cast<int>(sampled_fascia_sign_)};
    dashpot::slip_network_scratch<scalar, 3> network_skin_grip_scratch;
    dashpot::slip_network<scalar> network_skin_grip_step(network_skin_grip_links_, 3, {network_skin_grip_between_,
        network_skin_grip_to_tool_, network_skin_grip_to_ground_, 0.0}, 3, network_skin_grip_scratch.room());
    const scalar slips_force = network_skin_grip_step.step(position_change, network_skin_grip_held,
        network_skin_grip_moved, network_skin_grip_sign);
    const scalar network_skin_grip_end_1_moved = network_skin_grip_moved[0];
    const scalar network_skin_grip_end_2_moved = network_skin_grip_moved[1];
    const scalar network_skin_grip_end_3_moved = network_skin_grip_moved[2];
    const scalar skin_grip_sign = static_cast<scalar>(network_skin_grip_sign[0]);
    const scalar muscle_grip_sign = static_cast<scalar>(network_skin_grip_sign[1]);
    const scalar fascia_sign = static_cast<scalar>(network_skin_grip_sign[2]);
    // b∞/h of the slips that give way now
    const scalar slips_feedthrough = zero * rate;
    // b for the slips that the command counts as sliding
    const scalar slips_brake = zero;
    // m = f − b u̇
    const scalar force = step_stiffness_ * position_change + held_force_ +
        slips_force - slips_feedthrough * position_change + velocity_gain_ * velocity;
    // b
    const scalar brake = steady_brake_ + slips_brake;
    sampled_ = false;
    if (!dashpot::all_finite(force)) return {last_brake_, 0};
    sampled_ = true;
    sampled_skin_grip_sign_ = skin_grip_sign;
    sampled_muscle_grip_sign_ = muscle_grip_sign;
    sampled_fascia_sign_ = fascia_sign;
    last_brake_ = brake;
    sampled_position_ = position;
    sampled_position_change_ = position_change;
    sampled_network_skin_grip_end_1_moved_ = network_skin_grip_end_1_moved;
    sampled_network_skin_grip_end_2_moved_ = network_skin_grip_end_2_moved;
    sampled_network_skin_grip_end_3_moved_ = network_skin_grip_end_3_moved;
    return {brake, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    const scalar presliding_stretched = sampled_position_change_ - sampled_network_skin_grip_end_1_moved_;
    // z ← z + δ
    presliding_elongation_ = dashpot::flush_below(threshold, presliding_elongation_ + presliding_stretched);
    // z ← z + δ
    skin_elasticity_elongation_ = dashpot::flush_below(threshold, skin_elasticity_elongation_ +
        sampled_network_skin_grip_end_2_moved_);
    // z ← z + δ
    muscle_rest_elongation_ = dashpot::flush_below(threshold, muscle_rest_elongation_ +
        sampled_network_skin_grip_end_3_moved_);
    // z ← z + φ δ − α z
    muscle_elasticity_muscle_viscosity_elongation_ = dashpot::flush_below(threshold,
        muscle_elasticity_muscle_viscosity_elongation_ +
        (muscle_elasticity_muscle_viscosity_kept_ *
        sampled_network_skin_grip_end_3_moved_ - muscle_elasticity_muscle_viscosity_loss_ *
        muscle_elasticity_muscle_viscosity_elongation_));
    // force if the tool stays
    held_force_ = zero;
    // force if the block keeps its length
    presliding_held_ = presliding * presliding_elongation_;
    // force if the block keeps its length
    skin_elasticity_skin_viscosity_held_ = skin_elasticity * skin_elasticity_elongation_;
    // force if the block keeps its length
    muscle_elasticity_to_muscle_rest_held_ = muscle_rest * muscle_rest_elongation_ +
        (muscle_stiffness_ * muscle_elasticity_muscle_viscosity_elongation_ - muscle_stiffness_ *
        (muscle_elasticity_muscle_viscosity_loss_ * muscle_elasticity_muscle_viscosity_elongation_));
    // u₋ = u
    last_position_ = sampled_position_;
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
    clamped |= dashpot::take_value(tunables[0], wanted.skin_friction, skin_friction_) << 0;
    clamped |= dashpot::take_value(tunables[1], wanted.muscle_friction, muscle_friction_) << 1;
    clamped |= dashpot::take_value(tunables[2], wanted.muscle_stiffness, muscle_stiffness_) << 2;
    // x = h k/B
    muscle_elasticity_muscle_viscosity_ratio_ = dashpot::clamp_to(largest_ratio,
        muscle_stiffness_ * period / muscle_viscosity);
    // φ = (1 − e^(−x))/x
    muscle_elasticity_muscle_viscosity_kept_ = dashpot::mean_decay(muscle_elasticity_muscle_viscosity_ratio_);
    // α = x φ
    muscle_elasticity_muscle_viscosity_loss_ = muscle_elasticity_muscle_viscosity_ratio_ *
        muscle_elasticity_muscle_viscosity_kept_;
    // g of all that joins tool and ground without a slip
    step_stiffness_ = zero;
    const scalar skin_elasticity_skin_viscosity_answer_alone = skin_elasticity + skin_viscosity * rate;
    const scalar muscle_elasticity_to_muscle_rest_answer_alone = muscle_rest +
        muscle_stiffness_ * muscle_elasticity_muscle_viscosity_kept_;
    skin_grip_yield_ = skin_friction_ - skin_grip_least_yield > 0 ? skin_friction_ : skin_grip_least_yield;
    muscle_grip_yield_ = muscle_friction_ - muscle_grip_least_yield > 0 ? muscle_friction_ :
        muscle_grip_least_yield;
    network_skin_grip_1_to_tool_ = presliding;
    network_skin_grip_2_to_ground_ = skin_elasticity_skin_viscosity_answer_alone -
        skin_elasticity_skin_viscosity_least_answer > 0 ? skin_elasticity_skin_viscosity_answer_alone :
        skin_elasticity_skin_viscosity_least_answer;
    network_skin_grip_3_to_ground_ = muscle_elasticity_to_muscle_rest_answer_alone -
        muscle_elasticity_to_muscle_rest_least_answer > 0 ? muscle_elasticity_to_muscle_rest_answer_alone :
        muscle_elasticity_to_muscle_rest_least_answer;
    // b: drag
    steady_brake_ = drag;
    // b∞ − b
    velocity_gain_ = drag - steady_brake_;
    brake_left_ = max_damping - steady_brake_;
    const scalar muscle_elasticity_muscle_viscosity_force_before =
        muscle_elasticity_muscle_viscosity_carried_stiffness_ * muscle_elasticity_muscle_viscosity_elongation_;
    // F, or F √(k′/k) where the new stiffness k′ is lower
    const scalar muscle_elasticity_muscle_viscosity_force_kept =
        muscle_elasticity_muscle_viscosity_carried_stiffness_ - muscle_stiffness_ > 0 ? (muscle_stiffness_ > 0 ?
        muscle_elasticity_muscle_viscosity_force_before *
        dashpot::square_root(muscle_stiffness_ / muscle_elasticity_muscle_viscosity_carried_stiffness_) : zero) :
        muscle_elasticity_muscle_viscosity_force_before;
    const scalar muscle_elasticity_muscle_viscosity_energy_before =
        muscle_elasticity_muscle_viscosity_carried_stiffness_ > 0 ?
        muscle_elasticity_muscle_viscosity_force_before *
        (muscle_elasticity_muscle_viscosity_force_before / muscle_elasticity_muscle_viscosity_carried_stiffness_) / two : zero;
    const scalar muscle_elasticity_muscle_viscosity_energy_after = muscle_stiffness_ > 0 ?
        muscle_elasticity_muscle_viscosity_force_before *
        (muscle_elasticity_muscle_viscosity_force_before / muscle_stiffness_) / two : zero;
    tank_ = tank_ + (muscle_stiffness_ - muscle_elasticity_muscle_viscosity_carried_stiffness_ > 0 ?
        muscle_elasticity_muscle_viscosity_energy_before - muscle_elasticity_muscle_viscosity_energy_after : zero) +
        (muscle_stiffness_ > 0 ? zero : muscle_elasticity_muscle_viscosity_energy_before);
    const scalar muscle_elasticity_muscle_viscosity_energy_held = muscle_stiffness_ > 0 ?
        muscle_elasticity_muscle_viscosity_force_kept *
        (muscle_elasticity_muscle_viscosity_force_kept / muscle_stiffness_) / two : zero;
    const scalar muscle_elasticity_muscle_viscosity_energy_missing =
        muscle_elasticity_muscle_viscosity_energy_after - muscle_elasticity_muscle_viscosity_energy_held;
    const scalar muscle_elasticity_muscle_viscosity_force_most = dashpot::square_root(two * muscle_stiffness_ *
        (muscle_elasticity_muscle_viscosity_energy_held + tank_));
    const scalar muscle_elasticity_muscle_viscosity_force_short = muscle_elasticity_muscle_viscosity_force_kept -
        muscle_elasticity_muscle_viscosity_force_before;
    const scalar muscle_elasticity_muscle_viscosity_force_short_size =
        muscle_elasticity_muscle_viscosity_force_short > 0 ? muscle_elasticity_muscle_viscosity_force_short :
        zero - muscle_elasticity_muscle_viscosity_force_short;
    const scalar muscle_elasticity_muscle_viscosity_falls_short = muscle_stiffness_ > 0 ?
        muscle_elasticity_muscle_viscosity_force_short_size : zero;
    const scalar muscle_elasticity_muscle_viscosity_energy_unpaid =
        muscle_elasticity_muscle_viscosity_energy_missing - tank_;
    // F as before, as far as the energy in the tank allows
    const scalar muscle_elasticity_muscle_viscosity_force_after =
        muscle_elasticity_muscle_viscosity_falls_short > 0 ? (muscle_elasticity_muscle_viscosity_energy_unpaid > 0 ?
        (muscle_elasticity_muscle_viscosity_force_before > 0 ? muscle_elasticity_muscle_viscosity_force_most :
        minus_one *
        muscle_elasticity_muscle_viscosity_force_most) : muscle_elasticity_muscle_viscosity_force_before) :
        muscle_elasticity_muscle_viscosity_force_kept;
    tank_ = muscle_elasticity_muscle_viscosity_falls_short > 0 ?
        (muscle_elasticity_muscle_viscosity_energy_unpaid > 0 ? zero :
        tank_ - muscle_elasticity_muscle_viscosity_energy_missing) : tank_;
    const scalar muscle_elasticity_muscle_viscosity_force_change = muscle_elasticity_muscle_viscosity_force_after -
        muscle_elasticity_muscle_viscosity_force_before;
    const scalar muscle_elasticity_muscle_viscosity_force_change_size =
        muscle_elasticity_muscle_viscosity_force_change > 0 ? muscle_elasticity_muscle_viscosity_force_change :
        zero - muscle_elasticity_muscle_viscosity_force_change;
    const scalar muscle_elasticity_muscle_viscosity_stiffness_change = muscle_stiffness_ -
        muscle_elasticity_muscle_viscosity_carried_stiffness_;
    const scalar muscle_elasticity_muscle_viscosity_stiffness_change_size =
        muscle_elasticity_muscle_viscosity_stiffness_change > 0 ?
        muscle_elasticity_muscle_viscosity_stiffness_change :
        zero - muscle_elasticity_muscle_viscosity_stiffness_change;
    const scalar muscle_elasticity_muscle_viscosity_is_changed =
        muscle_elasticity_muscle_viscosity_force_change_size +
        muscle_elasticity_muscle_viscosity_stiffness_change_size;
    // z = F/k
    muscle_elasticity_muscle_viscosity_elongation_ = muscle_elasticity_muscle_viscosity_is_changed > 0 ?
        (muscle_stiffness_ > 0 ? muscle_elasticity_muscle_viscosity_force_after / muscle_stiffness_ : zero) :
        muscle_elasticity_muscle_viscosity_elongation_;
    muscle_elasticity_muscle_viscosity_carried_stiffness_ = muscle_stiffness_;
    // force if the tool stays
    held_force_ = zero;
    // force if the block keeps its length
    presliding_held_ = presliding * presliding_elongation_;
    // force if the block keeps its length
    skin_elasticity_skin_viscosity_held_ = skin_elasticity * skin_elasticity_elongation_;
    // force if the block keeps its length
    muscle_elasticity_to_muscle_rest_held_ = muscle_rest * muscle_rest_elongation_ +
        (muscle_stiffness_ * muscle_elasticity_muscle_viscosity_elongation_ - muscle_stiffness_ *
        (muscle_elasticity_muscle_viscosity_loss_ * muscle_elasticity_muscle_viscosity_elongation_));
    network_skin_grip_links_[0].lowest = -skin_grip_yield_;
    network_skin_grip_links_[0].highest = skin_grip_yield_;
    network_skin_grip_links_[1].lowest = -muscle_grip_yield_;
    network_skin_grip_links_[1].highest = muscle_grip_yield_;
    network_skin_grip_to_tool_[0] = network_skin_grip_1_to_tool_;
    network_skin_grip_to_ground_[1] = network_skin_grip_2_to_ground_;
    network_skin_grip_to_ground_[2] = network_skin_grip_3_to_ground_;
    return clamped;
  }

  // Energy in the springs, and set free by changes of parameters, after the last update() [J].
  scalar stored_energy() const noexcept {
    // V + tank: in the springs, and set free by changes of parameters
    const scalar stored = tank_ + presliding * presliding_elongation_ * presliding_elongation_ * half +
        skin_elasticity * skin_elasticity_elongation_ * skin_elasticity_elongation_ * half +
        muscle_rest * muscle_rest_elongation_ * muscle_rest_elongation_ * half +
        muscle_stiffness_ * muscle_elasticity_muscle_viscosity_elongation_ *
        muscle_elasticity_muscle_viscosity_elongation_ * half;
    return stored;
  }

 private:
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar drag = 3.0;  // as in the network [N s/m]
  static constexpr scalar presliding = 4000.0;  // as in the network [N/m]
  static constexpr scalar skin_elasticity = 400.0;  // as in the network [N/m]
  static constexpr scalar skin_viscosity = 3.0;  // as in the network [N s/m]
  static constexpr scalar muscle_rest = 200.0;  // as in the network [N/m]
  static constexpr scalar muscle_viscosity = 20.0;  // as in the network [N s/m]
  static constexpr scalar largest_ratio = 1.2676506002282294e+30;  // largest x: beyond it nothing is left after a sample [1]
  static constexpr scalar period = 0.001;  // h, the sample period [s]
  static constexpr scalar zero = 0.0;  // nothing [1]
  static constexpr scalar rate = 1000.0;  // 1/h [Hz]
  static constexpr scalar skin_grip_least_yield = 1.7881393432617188e-07;  // smallest Y, whatever the parameters are [N]
  static constexpr scalar muscle_grip_least_yield = 1.7881393432617188e-07;  // smallest Y, whatever the parameters are [N]
  static constexpr scalar skin_elasticity_skin_viscosity_least_answer = 0.00020265579223632812;  // smallest g, whatever the parameters are [N/m]
  static constexpr scalar muscle_elasticity_to_muscle_rest_least_answer = 0.00022801071038486737;  // smallest g, whatever the parameters are [N/m]
  static constexpr scalar max_damping = 1.7976931348623157e+308;  // largest damping that the brake can give [N·s/m]
  static constexpr scalar two = 2.0;  // two [1]
  static constexpr scalar minus_one = -1.0;  // minus one [1]
  static constexpr scalar half = 0.5;  // a half [1]
  static constexpr dashpot::tunable_range<scalar> tunables[3] = {
      {0.8, 0.0, 3.0},  // skin_friction [N]
      {1.2, 0.0, 3.0},  // muscle_friction [N]
      {900.0, 100.0, 4000.0},  // muscle_stiffness [N/m]
  };

  scalar held_force_ = 0;  // force of the springs if the tool stays [N]
  scalar skin_friction_ = 0.8;  // parameter [N]
  scalar muscle_friction_ = 1.2;  // parameter [N]
  scalar muscle_stiffness_ = 900.0;  // parameter [N/m]
  scalar muscle_elasticity_muscle_viscosity_ratio_ = 0.045;  // x, the sample period over the relaxation time [1]
  scalar muscle_elasticity_muscle_viscosity_kept_ = 0.9778337370422243;  // φ, share of a displacement that is left in the spring at the end of the sample [1]
  scalar muscle_elasticity_muscle_viscosity_loss_ = 0.044002518166900095;  // α, share of its elongation that is lost in a sample [1]
  scalar step_stiffness_ = 0;  // stiffness of the springs over one sample [N/m]
  scalar presliding_elongation_ = 0;  // z, elongation of the spring [m]
  scalar skin_elasticity_elongation_ = 0;  // z, elongation of the spring [m]
  scalar muscle_rest_elongation_ = 0;  // z, elongation of the spring [m]
  scalar muscle_elasticity_muscle_viscosity_elongation_ = 0;  // z, elongation of the spring [m]
  scalar muscle_elasticity_muscle_viscosity_carried_stiffness_ = 900.0;  // k after the last change of parameters [N/m]
  scalar presliding_held_ = 0;  // force if the block keeps its length [N]
  scalar skin_elasticity_skin_viscosity_held_ = 0;  // force if the block keeps its length [N]
  scalar muscle_elasticity_to_muscle_rest_held_ = 0;  // force if the block keeps its length [N]
  scalar sampled_skin_grip_sign_ = 0;  // direction in which the slip slides, 0 while it holds, at this sample [1]
  scalar sampled_muscle_grip_sign_ = 0;  // direction in which the slip slides, 0 while it holds, at this sample [1]
  scalar sampled_fascia_sign_ = 0;  // direction in which the slip slides, 0 while it holds, at this sample [1]
  scalar tank_ = 0;  // energy set free by changes of parameters, not yet spent [J]
  scalar skin_grip_yield_ = 0.8;  // Y [N]
  scalar muscle_grip_yield_ = 1.2;  // Y [N]
  scalar network_skin_grip_1_to_tool_ = 4000.0;  // g between two ends [N/m]
  scalar network_skin_grip_2_to_ground_ = 3400.0;  // g between two ends [N/m]
  scalar network_skin_grip_3_to_ground_ = 1080.0503633380017;  // g between two ends [N/m]
  scalar steady_brake_ = 3.0;  // b of the parts that no slip changes [N·s/m]
  scalar velocity_gain_ = 0;  // b∞ − b [N·s/m]
  scalar brake_left_ = 1.7976931348623157e+308;  // damping that the brake has left for slips [N·s/m]
  scalar last_brake_ = 3.0;  // b of the sample before [N·s/m]
  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar sampled_network_skin_grip_end_1_moved_ = 0;  // displacement of an inner end, at this sample [m]
  scalar sampled_network_skin_grip_end_2_moved_ = 0;  // displacement of an inner end, at this sample [m]
  scalar sampled_network_skin_grip_end_3_moved_ = 0;  // displacement of an inner end, at this sample [m]
  scalar resting_brake_ = 0;  // b of the parts with slips that stick [N·s/m]
  scalar last_position_ = 0;  // u of the sample before [m]
  // ends, lowest and highest force of each slip; inner ends come first, then tool and ground
  dashpot::slip_link<scalar> network_skin_grip_links_[3] = {
      {0, 1, -0.8, 0.8},
      {0, 2, -1.2, 1.2},
      {1, 2, -0.5, 0.5},
  };
  // stiffness over one sample between inner ends, to the tool and to the ground [N/m] or [N·m/rad]
  scalar network_skin_grip_between_[9] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  scalar network_skin_grip_to_tool_[3] = {4000.0, 0.0, 0.0};
  scalar network_skin_grip_to_ground_[3] = {0.0, 3400.0, 1080.0503633380017};
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
