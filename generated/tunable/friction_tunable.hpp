// Presliding and Coulomb friction beside a viscous drag, all of which change while it runs
//
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly, except in
//   samples in which a slip or a contact changes
// brake: makes b = 12 N·s/m of damping and, in the parts with slips, what the next lines give, and the motor the
//   rest of the force; by the rule 'faithful': without a device 'faithful' is the paper's rule: dampers at the
//   tool in parallel add
// slip rule of friction: velocity-free, parameters change while it runs; b is that of their default values; b = 0
//   N·s/m stuck, 0 sliding
// states: what the law remembers follows the measured position (position driven, so that a change of parameters
//   injects no energy)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: not certified: to be passive for any motion, whichever slips slide or stick and whether the tool
//   touches or not, any values within their ranges between changes, any brake that makes at least the commanded
//   damping, the law needs 2.5 N·s/m by a proof sample by sample, for commands that are held for up to 0.001 s; 0
//   N·s/m is guaranteed; the brake's command would have to be 2.5 N·s/m larger
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion, and for any values within their ranges, the law gives out no more work than
//   stored_energy() decreases by; rounding changes the force by at most 1.4e-15 of the sum of its terms'
//   magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// tunable: yield (0 to 5 N), presliding (200 to 5000 N/m), drag (0 to 40 N s/m)
//   set() itself injects no energy: raising a stiffness under load raises the force only as far as energy that
//   other springs release allows; but the motor still holds the force of the last sample, so call set() right
//   after step() and take the command from output() of the same sample
//   b [N·s/m] after set(): damper_3
// cost of output(): 7 additions, 4 multiplications, 0 guards against subnormal numbers
// cost of update(): 1 addition, 1 multiplication, 1 guard against subnormal numbers; 9 numbers kept between
//   samples
// cost of set(): 7 operations for the constants, 53 for the forces of springs and their energy
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved
//
// Written by dashpot 0.1.0 from a network with digest
// c86fcb8b7c393e3b623d21078d88e80af59e3eaf3833b10700b69af0c86379ba. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/elementary.hpp>
#include <dashpot/tunable_range.hpp>

namespace dashpot::generated {

class friction_tunable {
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
    scalar yield = 1.5;  // 0 to 5 [N]
    scalar presliding = 2000.0;  // 200 to 5000 [N/m]
    scalar drag = 12.0;  // 0 to 40 [N s/m]
  };

  // Starts at rest at `position` [m]: only the springs that hold a force at rest are loaded, from 0. A
  // NaN or infinite position counts as 0.
  void reset(scalar position = 0) noexcept {
    spring_2_elongation_ = 0;
    spring_2_held_ = 0;
    tank_ = 0;
    last_position_ = dashpot::all_finite(position, position, position) ? position : 0;
    sampled_position_ = 0;
    sampled_position_change_ = 0;
    sampled_spring_2_stretched_ = 0;
    // force if the tool stays
    held_force_ = zero;
    last_brake_ = steady_brake_;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s].
  // After a non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    // force of the slip if it held
    const scalar friction_trial = spring_2_answer_ * position_change + spring_2_held_;
    // clamp(trial, ±Y)
    const scalar friction_force = dashpot::clamp_to(friction_yield_, friction_trial);
    // excess = trial − force
    const scalar friction_excess = friction_trial - friction_force;
    // δ of the block
    const scalar spring_2_stretched = position_change + spring_2_given_way_ * friction_excess;
    // f
    const scalar slips_force = friction_force;
    // m = f − b u̇
    const scalar force = step_stiffness_ * position_change + held_force_ + slips_force + velocity_gain_ * velocity;
    // b
    const scalar brake = steady_brake_;
    sampled_ = false;
    if (!dashpot::all_finite(force)) return {last_brake_, 0};
    sampled_ = true;
    last_brake_ = brake;
    sampled_position_ = position;
    sampled_position_change_ = position_change;
    sampled_spring_2_stretched_ = spring_2_stretched;
    return {brake, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // z ← z + δ
    spring_2_elongation_ = dashpot::flush_below(threshold, spring_2_elongation_ + sampled_spring_2_stretched_);
    // force if the tool stays
    held_force_ = zero;
    // force if the block keeps its length
    spring_2_held_ = presliding_ * spring_2_elongation_;
    // u₋ = u
    last_position_ = sampled_position_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    // force of the slip if it held
    const scalar friction_trial = spring_2_answer_ * position_change + spring_2_held_;
    // clamp(trial, ±Y)
    const scalar friction_force = dashpot::clamp_to(friction_yield_, friction_trial);
    // excess = trial − force
    const scalar friction_excess = friction_trial - friction_force;
    // δ of the block
    const scalar spring_2_stretched = position_change + spring_2_given_way_ * friction_excess;
    // f
    const scalar slips_force = friction_force;
    // m = f − b u̇
    const scalar force = step_stiffness_ * position_change + held_force_ + slips_force + velocity_gain_ * velocity;
    // b
    const scalar brake = steady_brake_;
    if (!dashpot::all_finite(force)) {
      sampled_ = false;
      return {last_brake_, 0};
    }
    last_brake_ = brake;
    // z ← z + δ
    spring_2_elongation_ = dashpot::flush_below(threshold, spring_2_elongation_ + spring_2_stretched);
    // force if the tool stays
    held_force_ = zero;
    // force if the block keeps its length
    spring_2_held_ = presliding_ * spring_2_elongation_;
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
    clamped |= dashpot::take_value(tunables[0], wanted.yield, yield_) << 0;
    clamped |= dashpot::take_value(tunables[1], wanted.presliding, presliding_) << 1;
    clamped |= dashpot::take_value(tunables[2], wanted.drag, drag_) << 2;
    // g of all that joins tool and ground without a slip
    step_stiffness_ = zero;
    friction_yield_ = yield_ - friction_least_yield > 0 ? yield_ : friction_least_yield;
    spring_2_answer_ = presliding_ - spring_2_least_answer > 0 ? presliding_ : spring_2_least_answer;
    const scalar friction_moved_1 = one / spring_2_answer_;
    spring_2_given_way_ = zero - friction_moved_1;
    // b: damper_3
    steady_brake_ = drag_;
    // b∞ − b
    velocity_gain_ = drag_ - steady_brake_;
    const scalar spring_2_force_before = spring_2_carried_stiffness_ * spring_2_elongation_;
    // F, or F √(k′/k) where the new stiffness k′ is lower
    const scalar spring_2_force_kept = spring_2_carried_stiffness_ - presliding_ > 0 ? (presliding_ > 0 ?
        spring_2_force_before *
        dashpot::square_root(presliding_ / spring_2_carried_stiffness_) : zero) : spring_2_force_before;
    const scalar spring_2_energy_before = spring_2_carried_stiffness_ > 0 ? spring_2_force_before *
        (spring_2_force_before / spring_2_carried_stiffness_) / two : zero;
    const scalar spring_2_energy_after = presliding_ > 0 ? spring_2_force_before *
        (spring_2_force_before / presliding_) / two : zero;
    tank_ = tank_ + (presliding_ - spring_2_carried_stiffness_ > 0 ?
        spring_2_energy_before - spring_2_energy_after : zero) + (presliding_ > 0 ? zero : spring_2_energy_before);
    const scalar spring_2_energy_held = presliding_ > 0 ? spring_2_force_kept *
        (spring_2_force_kept / presliding_) / two : zero;
    const scalar spring_2_energy_missing = spring_2_energy_after - spring_2_energy_held;
    const scalar spring_2_force_most = dashpot::square_root(two * presliding_ * (spring_2_energy_held + tank_));
    const scalar spring_2_force_short = spring_2_force_kept - spring_2_force_before;
    const scalar spring_2_force_short_size = spring_2_force_short > 0 ? spring_2_force_short :
        zero - spring_2_force_short;
    const scalar spring_2_falls_short = presliding_ > 0 ? spring_2_force_short_size : zero;
    const scalar spring_2_energy_unpaid = spring_2_energy_missing - tank_;
    // F as before, as far as the energy in the tank allows
    const scalar spring_2_force_after = spring_2_falls_short > 0 ? (spring_2_energy_unpaid > 0 ?
        (spring_2_force_before > 0 ? spring_2_force_most : minus_one *
        spring_2_force_most) : spring_2_force_before) : spring_2_force_kept;
    tank_ = spring_2_falls_short > 0 ? (spring_2_energy_unpaid > 0 ? zero : tank_ - spring_2_energy_missing) :
        tank_;
    const scalar spring_2_force_change = spring_2_force_after - spring_2_force_before;
    const scalar spring_2_force_change_size = spring_2_force_change > 0 ? spring_2_force_change :
        zero - spring_2_force_change;
    const scalar spring_2_stiffness_change = presliding_ - spring_2_carried_stiffness_;
    const scalar spring_2_stiffness_change_size = spring_2_stiffness_change > 0 ? spring_2_stiffness_change :
        zero - spring_2_stiffness_change;
    const scalar spring_2_is_changed = spring_2_force_change_size + spring_2_stiffness_change_size;
    // z = F/k
    spring_2_elongation_ = spring_2_is_changed > 0 ? (presliding_ > 0 ? spring_2_force_after / presliding_ : zero) :
        spring_2_elongation_;
    spring_2_carried_stiffness_ = presliding_;
    // force if the tool stays
    held_force_ = zero;
    // force if the block keeps its length
    spring_2_held_ = presliding_ * spring_2_elongation_;
    return clamped;
  }

  // Energy in the springs, and set free by changes of parameters, after the last update() [J].
  scalar stored_energy() const noexcept {
    // V + tank: in the springs, and set free by changes of parameters
    const scalar stored = tank_ + presliding_ * spring_2_elongation_ * spring_2_elongation_ * half;
    return stored;
  }

 private:
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar zero = 0.0;  // nothing [1]
  static constexpr scalar spring_2_least_answer = 0.0002980232238769531;  // smallest g, whatever the parameters are [N/m]
  static constexpr scalar friction_least_yield = 2.980232238769531e-07;  // smallest Y, whatever the parameters are [N]
  static constexpr scalar one = 1.0;  // one [1]
  static constexpr scalar two = 2.0;  // two [1]
  static constexpr scalar minus_one = -1.0;  // minus one [1]
  static constexpr scalar half = 0.5;  // a half [1]
  static constexpr dashpot::tunable_range<scalar> tunables[3] = {
      {1.5, 0.0, 5.0},  // yield [N]
      {2000.0, 200.0, 5000.0},  // presliding [N/m]
      {12.0, 0.0, 40.0},  // drag [N s/m]
  };

  scalar held_force_ = 0;  // force of the springs if the tool stays [N]
  scalar yield_ = 1.5;  // parameter [N]
  scalar presliding_ = 2000.0;  // parameter [N/m]
  scalar drag_ = 12.0;  // parameter [N s/m]
  scalar step_stiffness_ = 0;  // stiffness of the springs over one sample [N/m]
  scalar spring_2_elongation_ = 0;  // z, elongation of the spring [m]
  scalar spring_2_carried_stiffness_ = 2000.0;  // k after the last change of parameters [N/m]
  scalar spring_2_held_ = 0;  // force if the block keeps its length [N]
  scalar tank_ = 0;  // energy set free by changes of parameters, not yet spent [J]
  scalar friction_yield_ = 1.5;  // Y [N]
  scalar spring_2_answer_ = 2000.0;  // g, stiffness of the block over one sample [N/m]
  scalar spring_2_given_way_ = -0.0005;  // δ for each newton that the slip does not hold [m/N]
  scalar steady_brake_ = 12.0;  // b of the parts that no slip changes [N·s/m]
  scalar velocity_gain_ = 0;  // b∞ − b [N·s/m]
  scalar last_brake_ = 12.0;  // b of the sample before [N·s/m]
  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar sampled_spring_2_stretched_ = 0;  // at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
