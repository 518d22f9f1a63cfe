// A Kelvin element in series with a spring: a tunable that mixes with its relaxation
//
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly, except the
//   elements listed below under 'backward Euler'
// brake: makes b = 8 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': in series,
//   (spring_1 | B1) dissipates 100 % of the energy at low frequency, so that the brake makes its 8 N s/m
// states: what the law remembers follows the measured position (position driven, so that a change of parameters
//   injects no energy)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: not certified: to be passive for any motion, any values within their ranges between changes, any
//   brake that makes at least the commanded damping, the law needs 16.4 N·s/m by a proof sample by sample, for
//   commands that are held for up to 0.001 s; 8 N·s/m is guaranteed; the brake's command would have to be 8.4
//   N·s/m larger
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion, and for any values within their ranges, the law gives out no more work than
//   stored_energy() decreases by; rounding changes the force by at most 3.1e-15 of the sum of its terms'
//   magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// tunable: K1 (50 to 800 N/m)
//   set() itself injects no energy: raising a stiffness under load raises the force only as far as energy that
//   other springs release allows; but the motor still holds the force of the last sample, so call set() right
//   after step() and take the command from output() of the same sample
//   b [N·s/m] after set(): B1
//   by backward Euler, because their relaxations depend on a tunable or on several slips: spring_1, B1, K2
// cost of output(): 3 additions, 2 multiplications, 0 guards against subnormal numbers
// cost of update(): 14 additions, 9 multiplications, 3 guards against subnormal numbers; 10 numbers kept between
//   samples
// cost of set(): 14 operations for the constants, 67 for the forces of springs and their energy
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved
//
// Written by dashpot 0.1.0 from a network with digest
// b57d94149fbc717b05578019de4d32e026e1596c4f3a169d2568b21102a47de3. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/elementary.hpp>
#include <dashpot/tunable_range.hpp>

namespace dashpot::generated {

class standard_solid_tunable {
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
    scalar K1 = 200.0;  // 50 to 800 [N/m]
  };

  // Starts at rest at `position` [m]: only the springs that hold a force at rest are loaded, from 0. A
  // NaN or infinite position counts as 0.
  void reset(scalar position = 0) noexcept {
    spring_1_offset_ = 0;
    tank_ = 0;
    last_position_ = dashpot::all_finite(position, position, position) ? position : 0;
    sampled_position_ = 0;
    sampled_position_change_ = 0;
    const scalar loaded_node_1_sum = K1_ + K2;
    const scalar loaded_node_1_quotient = loaded_node_1_sum > 0 ? one / loaded_node_1_sum : zero;
    const scalar loaded_node_1_inverse = one - (loaded_node_1_quotient - loaded_node_1_quotient) > 0 ?
        loaded_node_1_quotient : zero;
    const scalar loaded_node_1_port_share = K1_ * loaded_node_1_inverse;
    const scalar loaded_node_1_moved = loaded_node_1_port_share * last_position_;
    // z = δ
    spring_1_elongation_ = dashpot::flush_below(threshold, last_position_ - loaded_node_1_moved);
    // z = δ
    K2_elongation_ = dashpot::flush_below(threshold, loaded_node_1_moved);
    const scalar spring_1_force = K1_ * (spring_1_elongation_ - spring_1_offset_);
    const scalar K2_force = K2 * K2_elongation_;
    node_1_push_ = zero + spring_1_force - K2_force;
    // force if the tool stays
    held_force_ = spring_1_force - node_1_port_share_ * node_1_push_;
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
    const scalar node_1_moved = node_1_inverse_ * node_1_push_ + node_1_port_share_ * sampled_position_change_;
    // z ← z + δ
    spring_1_elongation_ = dashpot::flush_below(threshold, spring_1_elongation_ +
        (sampled_position_change_ - node_1_moved));
    // z ← z + δ
    K2_elongation_ = dashpot::flush_below(threshold, K2_elongation_ + node_1_moved);
    const scalar spring_1_offset_after = dashpot::flush_below(threshold, retention * spring_1_offset_);
    const scalar spring_1_offset_cost = K1_ * (spring_1_offset_ - spring_1_offset_after) *
        (spring_1_elongation_ - spring_1_offset_after + (spring_1_elongation_ - spring_1_offset_)) * half;
    const scalar spring_1_offset_unpaid = spring_1_offset_cost - tank_;
    tank_ = spring_1_offset_unpaid > 0 ? tank_ : tank_ - spring_1_offset_cost;
    // r moves towards 0 if the tank has the energy for it
    spring_1_offset_ = spring_1_offset_unpaid > 0 ? spring_1_offset_ : spring_1_offset_after;
    const scalar spring_1_force = K1_ * (spring_1_elongation_ - spring_1_offset_);
    const scalar K2_force = K2 * K2_elongation_;
    node_1_push_ = zero + spring_1_force - K2_force;
    // force if the tool stays
    held_force_ = spring_1_force - node_1_port_share_ * node_1_push_;
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
    const scalar node_1_moved = node_1_inverse_ * node_1_push_ + node_1_port_share_ * position_change;
    // z ← z + δ
    spring_1_elongation_ = dashpot::flush_below(threshold, spring_1_elongation_ + (position_change - node_1_moved));
    // z ← z + δ
    K2_elongation_ = dashpot::flush_below(threshold, K2_elongation_ + node_1_moved);
    const scalar spring_1_offset_after = dashpot::flush_below(threshold, retention * spring_1_offset_);
    const scalar spring_1_offset_cost = K1_ * (spring_1_offset_ - spring_1_offset_after) *
        (spring_1_elongation_ - spring_1_offset_after + (spring_1_elongation_ - spring_1_offset_)) * half;
    const scalar spring_1_offset_unpaid = spring_1_offset_cost - tank_;
    tank_ = spring_1_offset_unpaid > 0 ? tank_ : tank_ - spring_1_offset_cost;
    // r moves towards 0 if the tank has the energy for it
    spring_1_offset_ = spring_1_offset_unpaid > 0 ? spring_1_offset_ : spring_1_offset_after;
    const scalar spring_1_force = K1_ * (spring_1_elongation_ - spring_1_offset_);
    const scalar K2_force = K2 * K2_elongation_;
    node_1_push_ = zero + spring_1_force - K2_force;
    // force if the tool stays
    held_force_ = spring_1_force - node_1_port_share_ * node_1_push_;
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
    clamped |= dashpot::take_value(tunables[0], wanted.K1, K1_) << 0;
    const scalar node_1_to_port = rate * B1 + K1_;
    const scalar node_1_sum = node_1_to_port + K2;
    const scalar node_1_quotient = node_1_sum > 0 ? one / node_1_sum : zero;
    node_1_inverse_ = one - (node_1_quotient - node_1_quotient) > 0 ? node_1_quotient : zero;
    node_1_port_share_ = node_1_to_port * node_1_inverse_;
    const scalar through_node_1 = node_1_port_share_ * K2;
    // g of all that joins tool and ground without a slip
    springs_stiffness_ = zero;
    // g − b∞/h of the meshes
    mesh_stiffness_ = through_node_1 - zero * rate;
    // b∞ of the meshes
    mesh_feedthrough_ = zero;
    step_stiffness_ = springs_stiffness_ + mesh_stiffness_;
    // b: B1
    steady_brake_ = B1;
    // b∞ − b
    velocity_gain_ = mesh_feedthrough_ - steady_brake_;
    const scalar spring_1_force_before = spring_1_carried_stiffness_ * (spring_1_elongation_ - spring_1_offset_);
    // F, or F √(k′/k) where the new stiffness k′ is lower
    const scalar spring_1_force_kept = spring_1_carried_stiffness_ - K1_ > 0 ? (K1_ > 0 ? spring_1_force_before *
        dashpot::square_root(K1_ / spring_1_carried_stiffness_) : zero) : spring_1_force_before;
    const scalar spring_1_energy_before = spring_1_carried_stiffness_ > 0 ? spring_1_force_before *
        (spring_1_force_before / spring_1_carried_stiffness_) / two : zero;
    const scalar spring_1_energy_after = K1_ > 0 ? spring_1_force_before *
        (spring_1_force_before / K1_) / two : zero;
    tank_ = tank_ + (K1_ - spring_1_carried_stiffness_ > 0 ? spring_1_energy_before - spring_1_energy_after :
        zero) + (K1_ > 0 ? zero : spring_1_energy_before);
    const scalar spring_1_energy_held = K1_ > 0 ? spring_1_force_kept * (spring_1_force_kept / K1_) / two : zero;
    const scalar spring_1_energy_missing = spring_1_energy_after - spring_1_energy_held;
    const scalar spring_1_force_most = dashpot::square_root(two * K1_ * (spring_1_energy_held + tank_));
    const scalar spring_1_force_short = spring_1_force_kept - spring_1_force_before;
    const scalar spring_1_force_short_size = spring_1_force_short > 0 ? spring_1_force_short :
        zero - spring_1_force_short;
    const scalar spring_1_falls_short = K1_ > 0 ? spring_1_force_short_size : zero;
    const scalar spring_1_energy_unpaid = spring_1_energy_missing - tank_;
    // F as before, as far as the energy in the tank allows
    const scalar spring_1_force_after = spring_1_falls_short > 0 ? (spring_1_energy_unpaid > 0 ?
        (spring_1_force_before > 0 ? spring_1_force_most : minus_one *
        spring_1_force_most) : spring_1_force_before) : spring_1_force_kept;
    tank_ = spring_1_falls_short > 0 ? (spring_1_energy_unpaid > 0 ? zero : tank_ - spring_1_energy_missing) :
        tank_;
    const scalar spring_1_force_change = spring_1_force_after - spring_1_force_before;
    const scalar spring_1_force_change_size = spring_1_force_change > 0 ? spring_1_force_change :
        zero - spring_1_force_change;
    const scalar spring_1_stiffness_change = K1_ - spring_1_carried_stiffness_;
    const scalar spring_1_stiffness_change_size = spring_1_stiffness_change > 0 ? spring_1_stiffness_change :
        zero - spring_1_stiffness_change;
    const scalar spring_1_is_changed = spring_1_force_change_size + spring_1_stiffness_change_size;
    const scalar spring_1_offset_exact = K1_ > 0 ? spring_1_elongation_ - spring_1_force_after / K1_ : zero;
    const scalar spring_1_offset_seen = spring_1_elongation_ +
        spring_1_offset_exact * quarter - spring_1_elongation_;
    const scalar spring_1_offset_seen_size = spring_1_offset_seen > 0 ? spring_1_offset_seen :
        zero - spring_1_offset_seen;
    // r = z − F/k
    spring_1_offset_ = spring_1_is_changed > 0 ? (spring_1_offset_seen_size > 0 ? spring_1_offset_exact : zero) :
        spring_1_offset_;
    spring_1_carried_stiffness_ = K1_;
    const scalar spring_1_force = K1_ * (spring_1_elongation_ - spring_1_offset_);
    const scalar K2_force = K2 * K2_elongation_;
    node_1_push_ = zero + spring_1_force - K2_force;
    // force if the tool stays
    held_force_ = spring_1_force - node_1_port_share_ * node_1_push_;
    return clamped;
  }

  // Energy in the springs, and set free by changes of parameters, after the last update() [J].
  scalar stored_energy() const noexcept {
    // V + tank: in the springs, and set free by changes of parameters
    const scalar stored = tank_ +
        K1_ * (spring_1_elongation_ - spring_1_offset_) * (spring_1_elongation_ - spring_1_offset_) * half +
        K2 * K2_elongation_ * K2_elongation_ * half;
    return stored;
  }

 private:
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar B1 = 8.0;  // as in the network [N s/m]
  static constexpr scalar K2 = 600.0;  // as in the network [N/m]
  static constexpr scalar rate = 1000.0;  // 1/h [Hz]
  static constexpr scalar zero = 0.0;  // nothing [1]
  static constexpr scalar one = 1.0;  // one [1]
  static constexpr scalar two = 2.0;  // two [1]
  static constexpr scalar minus_one = -1.0;  // minus one [1]
  static constexpr scalar quarter = 0.25;  // a quarter [1]
  static constexpr scalar retention = 0.9900498337491681;  // share of r that is left after a sample [1]
  static constexpr scalar half = 0.5;  // a half [1]
  static constexpr dashpot::tunable_range<scalar> tunables[1] = {
      {200.0, 50.0, 800.0},  // K1 [N/m]
  };

  scalar held_force_ = 0;  // force of the springs if the tool stays [N]
  scalar K1_ = 200.0;  // parameter [N/m]
  scalar springs_stiffness_ = 0;  // stiffness of the springs over one sample [N/m]
  scalar spring_1_elongation_ = 0;  // z, elongation of the spring [m]
  scalar spring_1_carried_stiffness_ = 200.0;  // k after the last change of parameters [N/m]
  scalar K2_elongation_ = 0;  // z, elongation of the spring [m]
  scalar node_1_push_ = 0;  // force of the springs on an inner node [N]
  scalar spring_1_offset_ = 0;  // r, shift of the spring's rest length [m]
  scalar tank_ = 0;  // energy set free by changes of parameters, not yet spent [J]
  scalar node_1_inverse_ = 0.00011363636363636364;  // of a mesh's elimination [1]
  scalar node_1_port_share_ = 0.9318181818181818;  // of a mesh's elimination [1]
  scalar mesh_stiffness_ = 559.090909090909;  // stiffness of the meshes over one sample [N/m]
  scalar mesh_feedthrough_ = 0;  // b∞ of the meshes [N·s/m]
  scalar step_stiffness_ = 559.090909090909;  // stiffness of springs and meshes over one sample [N/m]
  scalar steady_brake_ = 8.0;  // b of the parts that no slip changes [N·s/m]
  scalar velocity_gain_ = -8.0;  // b∞ − b [N·s/m]
  scalar last_brake_ = 8.0;  // b of the sample before [N·s/m]
  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
