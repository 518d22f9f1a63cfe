// General viscoelastic solid, Fig. 2e, with two values that change while it runs: many points at once
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
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved
//
// Written by dashpot 0.1.0 from a network with digest
// 5c194d7008f5fe1bb0e1c8f01d1156815ca3b1ae3e5903a351efbfbd8297cdca. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/exponential.hpp>
#include <dashpot/elementary.hpp>
#include <dashpot/tunable_range.hpp>
#include <dashpot/vector.hpp>

namespace dashpot::generated {

// Many points, each with a network of its own. The results of every point are, to the last bit, those of a
// second_order_maxwell_tunable with the same samples, whatever the number of points and the registers of the machine.
class second_order_maxwell_tunable_batch {
 public:
  using scalar = double;
  static constexpr scalar sample_period = 0.001;  // [s]
  static constexpr dashpot::motion port_motion = dashpot::motion::translation;

  struct parameters {
    scalar K1 = 12.0;  // 0 to 100 [N/m]
    scalar B2 = 6.0;  // 0.5 to 20 [N s/m]
  };

  // How many scalars are kept for each point, and how many points make a block. In a block the scalars lie state by
  // state, so that memory is read and written in one stream.
  static constexpr int states = 18;
  static constexpr int block = 64 / static_cast<int>(sizeof(scalar));

  // Scalars of storage that `points` points need.
  static constexpr long long storage_size(long long points) noexcept { return (points + block - 1) / block * block * states; }

  // `storage` has room for storage_size(points) scalars and outlives this; it is best aligned to 64 bytes.
  second_order_maxwell_tunable_batch(scalar* storage, long long points) noexcept : storage_(storage), points_(points) { begin(); reset(); }

  long long points() const noexcept { return points_; }

  // All points at rest at `position` [m]; a NaN or infinite one counts as 0.
  void reset(scalar position = 0) noexcept {
    for (long long point = 0; point < points_; ++point) reset_point(point, position);
  }

  void reset_point(long long point, [[maybe_unused]] scalar position = 0) noexcept {
    [[maybe_unused]] scalar* const state = state_of(point);
    position = dashpot::all_finite(position, position, position) ? position : scalar(0);
    put(state, 0, 0.0);
    put(state, 8, 0.0);
    put(state, 9, 0.0);
    put(state, 11, 0.0);
    put(state, 12, 0.0);
    put(state, 13, 0.0);
    put(state, 16, position);
    put(state, 17, 11.0);
    scalar held_force_ = state[0 * block];
    const scalar K1_ = state[1 * block];
    const scalar B1_spring_2_loss_ = state[4 * block];
    const scalar damper_3_K2_loss_ = state[6 * block];
    scalar K3_elongation_ = state[8 * block];
    const scalar B1_spring_2_elongation_ = state[9 * block];
    const scalar damper_3_K2_elongation_ = state[11 * block];
    const scalar K3_offset_ = state[12 * block];
    const scalar steady_brake_ = state[14 * block];
    const scalar last_position_ = state[16 * block];
    scalar last_brake_ = state[17 * block];
    // z = u
    K3_elongation_ = last_position_;
    // force if the tool stays
    held_force_ = K3 * (K3_elongation_ - K3_offset_) +
        (K1_ * B1_spring_2_elongation_ - K1_ * (B1_spring_2_loss_ * B1_spring_2_elongation_)) +
        (K2 * damper_3_K2_elongation_ - K2 * (damper_3_K2_loss_ * damper_3_K2_elongation_));
    last_brake_ = steady_brake_;
    put(state, 0, held_force_);
    put(state, 8, K3_elongation_);
    put(state, 17, last_brake_);
  }

  // For one point. Call this right after step(), and take the commands from output() of the same samples: in a
  // loop that is not late the motor then holds the old force no longer, and a spring that changes injects no
  // energy. Bit i of the result: parameter i was beyond its range and is now at its bound, or it was NaN and
  // has not changed.
  unsigned set(long long point, const parameters& wanted) noexcept {
    scalar* const state = state_of(point);
    scalar held_force_ = state[0 * block];
    scalar K1_ = state[1 * block];
    scalar B2_ = state[2 * block];
    scalar B1_spring_2_kept_ = state[3 * block];
    scalar B1_spring_2_loss_ = state[4 * block];
    scalar damper_3_K2_kept_ = state[5 * block];
    scalar damper_3_K2_loss_ = state[6 * block];
    scalar step_stiffness_ = state[7 * block];
    const scalar K3_elongation_ = state[8 * block];
    scalar B1_spring_2_elongation_ = state[9 * block];
    scalar B1_spring_2_carried_stiffness_ = state[10 * block];
    const scalar damper_3_K2_elongation_ = state[11 * block];
    scalar K3_offset_ = state[12 * block];
    scalar tank_ = state[13 * block];
    scalar steady_brake_ = state[14 * block];
    scalar velocity_gain_ = state[15 * block];
    unsigned clamped = 0;
    clamped |= dashpot::take_value(tunables[0], wanted.K1, K1_) << 0;
    clamped |= dashpot::take_value(tunables[1], wanted.B2, B2_) << 1;
    // x = h k/B
    const scalar B1_spring_2_ratio_ = dashpot::clamp_to(largest_ratio, K1_ * period / B1);
    // φ = (1 − e^(−x))/x
    B1_spring_2_kept_ = dashpot::mean_decay(B1_spring_2_ratio_);
    // α = x φ
    B1_spring_2_loss_ = B1_spring_2_ratio_ * B1_spring_2_kept_;
    // x = h k/B
    const scalar damper_3_K2_ratio_ = dashpot::clamp_to(largest_ratio, K2 * period / B2_);
    // φ = (1 − e^(−x))/x
    damper_3_K2_kept_ = dashpot::mean_decay(damper_3_K2_ratio_);
    // α = x φ
    damper_3_K2_loss_ = damper_3_K2_ratio_ * damper_3_K2_kept_;
    // g of all that joins tool and ground without a slip
    step_stiffness_ = K3 + K1_ * B1_spring_2_kept_ + K2 * damper_3_K2_kept_;
    const scalar B1_damper_3_sum_ = B1_damper_3 + B2_;
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
    put(state, 0, held_force_);
    put(state, 1, K1_);
    put(state, 2, B2_);
    put(state, 3, B1_spring_2_kept_);
    put(state, 4, B1_spring_2_loss_);
    put(state, 5, damper_3_K2_kept_);
    put(state, 6, damper_3_K2_loss_);
    put(state, 7, step_stiffness_);
    put(state, 9, B1_spring_2_elongation_);
    put(state, 10, B1_spring_2_carried_stiffness_);
    put(state, 12, K3_offset_);
    put(state, 13, tank_);
    put(state, 14, steady_brake_);
    put(state, 15, velocity_gain_);
    return clamped;
  }

  // The commands for this sample of all points: positions [m] and velocities [m/s] to
  // forces and dampings. Changes no state: pass the same samples to update().
  void output(const scalar* positions, const scalar* velocities, scalar* dampings, scalar* forces) const noexcept {
    run<true, false>(positions, velocities, dampings, forces);
  }

  // Advances the states to the next sample. A point whose sample is not finite stays as it was.
  void update(const scalar* positions, const scalar* velocities) noexcept {
    run<false, true>(positions, velocities, nullptr, nullptr);
  }

  // output() and update() in one pass through the memory: 18 scalars read and 10 written a point.
  void step(const scalar* positions, const scalar* velocities, scalar* dampings, scalar* forces) noexcept {
    run<true, true>(positions, velocities, dampings, forces);
  }

  // Energy in the springs of the point [J].
  scalar stored_energy(long long point) const noexcept {
    using vector = dashpot::vector<scalar, 1>;
    [[maybe_unused]] const scalar* const state = state_of(point);
    const vector K1_ = vector::at(state, 1 * block);
    const vector K3_elongation_ = vector::at(state, 8 * block);
    const vector B1_spring_2_elongation_ = vector::at(state, 9 * block);
    const vector damper_3_K2_elongation_ = vector::at(state, 11 * block);
    const vector K3_offset_ = vector::at(state, 12 * block);
    const vector tank_ = vector::at(state, 13 * block);
    // V + tank: in the springs, and set free by changes of parameters
    const vector stored = tank_ + K3 * (K3_elongation_ - K3_offset_) * (K3_elongation_ - K3_offset_) * half +
        K1_ * B1_spring_2_elongation_ * B1_spring_2_elongation_ * half +
        K2 * damper_3_K2_elongation_ * damper_3_K2_elongation_ * half;
    return stored[0];
  }

 private:
  scalar* state_of(long long point) const noexcept { return storage_ + point / block * block * states + point % block; }

  // Through volatile: compilers turn a plain loop into a call of memset, which may not be there.
  static void put(volatile scalar* state, int number, scalar value) noexcept { state[number * block] = value; }

  template <bool gives_commands, bool advances>
  void run(const scalar* positions, const scalar* velocities, scalar* dampings, scalar* forces) const noexcept {
    using vector = dashpot::vector<scalar, dashpot::vector_width<scalar, 2 * block>>;
    long long point = 0;
    for (; point + block <= points_; point += block)
      DASHPOT_UNROLL
      for (int i = 0; i < block; i += vector::width)
        points_from<vector, gives_commands, advances>(point + i, positions, velocities, dampings, forces);
    for (; point < points_; ++point)
      points_from<dashpot::vector<scalar, 1>, gives_commands, advances>(point, positions, velocities, dampings, forces);
  }

  // `point` and those that follow it in a register.
  template <class vector, bool gives_commands, bool advances>
  void points_from(long long point, const scalar* positions, const scalar* velocities, scalar* dampings, scalar* forces) const noexcept {
    [[maybe_unused]] scalar* const state = state_of(point);
    const vector position = vector::at(positions, point), velocity = vector::at(velocities, point);
    vector held_force_ = vector::at(state, 0 * block);  // force of the springs if the tool stays [N]
    vector K1_ = vector::at(state, 1 * block);  // parameter [N/m]
    vector B1_spring_2_kept_ = vector::at(state, 3 * block);  // φ, share of a displacement that is left in the spring at the end of the sample [1]
    vector B1_spring_2_loss_ = vector::at(state, 4 * block);  // α, share of its elongation that is lost in a sample [1]
    vector damper_3_K2_kept_ = vector::at(state, 5 * block);  // φ, share of a displacement that is left in the spring at the end of the sample [1]
    vector damper_3_K2_loss_ = vector::at(state, 6 * block);  // α, share of its elongation that is lost in a sample [1]
    vector step_stiffness_ = vector::at(state, 7 * block);  // stiffness of the springs over one sample [N/m]
    vector K3_elongation_ = vector::at(state, 8 * block);  // z, elongation of the spring [m]
    vector B1_spring_2_elongation_ = vector::at(state, 9 * block);  // z, elongation of the spring [m]
    vector damper_3_K2_elongation_ = vector::at(state, 11 * block);  // z, elongation of the spring [m]
    vector K3_offset_ = vector::at(state, 12 * block);  // r, shift of the spring's rest length [m]
    vector tank_ = vector::at(state, 13 * block);  // energy set free by changes of parameters, not yet spent [J]
    vector steady_brake_ = vector::at(state, 14 * block);  // b of the parts that no slip changes [N·s/m]
    vector velocity_gain_ = vector::at(state, 15 * block);  // b∞ − b [N·s/m]
    vector last_position_ = vector::at(state, 16 * block);  // u of the sample before [m]
    vector last_brake_ = vector::at(state, 17 * block);  // b of the sample before [N·s/m]
    // Δu = u − u₋
    const vector position_change = position - last_position_;
    // m = f − b u̇
    const vector force = step_stiffness_ * position_change + held_force_ + velocity_gain_ * velocity;
    // b
    const vector brake = steady_brake_;
    const vector sampled = vector::all_finite(position, velocity, force);
    if constexpr (gives_commands) {
      vector::put(dampings, point, vector::where(sampled, brake, last_brake_));
      vector::put(forces, point, vector::where(sampled, force, scalar(0)));
    }
    if constexpr (advances) {
      last_brake_ = brake;
      const vector sampled_position_ = position;
      const vector sampled_position_change_ = position_change;
      // z ← z + φ δ − α z
      B1_spring_2_elongation_ = vector::flush_below(threshold, B1_spring_2_elongation_ +
          (B1_spring_2_kept_ * sampled_position_change_ - B1_spring_2_loss_ * B1_spring_2_elongation_));
      // z ← z + φ δ − α z
      damper_3_K2_elongation_ = vector::flush_below(threshold, damper_3_K2_elongation_ +
          (damper_3_K2_kept_ * sampled_position_change_ - damper_3_K2_loss_ * damper_3_K2_elongation_));
      // z = u
      K3_elongation_ = sampled_position_;
      const vector K3_offset_after = vector::flush_below(threshold, retention * K3_offset_);
      const vector K3_offset_cost = K3 * (K3_offset_ - K3_offset_after) * (K3_elongation_ - K3_offset_after +
          (K3_elongation_ - K3_offset_)) * half;
      const vector K3_offset_unpaid = K3_offset_cost - tank_;
      tank_ = vector::where(K3_offset_unpaid, tank_, tank_ - K3_offset_cost);
      // r moves towards 0 if the tank has the energy for it
      K3_offset_ = vector::where(K3_offset_unpaid, K3_offset_, K3_offset_after);
      // force if the tool stays
      held_force_ = K3 * (K3_elongation_ - K3_offset_) +
          (K1_ * B1_spring_2_elongation_ - K1_ * (B1_spring_2_loss_ * B1_spring_2_elongation_)) +
          (K2 * damper_3_K2_elongation_ - K2 * (damper_3_K2_loss_ * damper_3_K2_elongation_));
      // u₋ = u
      last_position_ = sampled_position_;
      vector::put(state, 0 * block, vector::where(sampled, held_force_, vector::at(state, 0 * block)));
      vector::put(state, 8 * block, vector::where(sampled, K3_elongation_, vector::at(state, 8 * block)));
      vector::put(state, 9 * block, vector::where(sampled, B1_spring_2_elongation_, vector::at(state, 9 * block)));
      vector::put(state, 11 * block, vector::where(sampled, damper_3_K2_elongation_, vector::at(state, 11 * block)));
      vector::put(state, 12 * block, vector::where(sampled, K3_offset_, vector::at(state, 12 * block)));
      vector::put(state, 13 * block, vector::where(sampled, tank_, vector::at(state, 13 * block)));
      vector::put(state, 16 * block, vector::where(sampled, last_position_, vector::at(state, 16 * block)));
      vector::put(state, 17 * block, vector::where(sampled, last_brake_, vector::at(state, 17 * block)));
    }
  }

  // All points get the initial values of the parameters.
  void begin() noexcept {
    for (long long point = 0; point < points_; ++point) {
      for (int number = 0; number < states; ++number) put(state_of(point), number, 0);
      set(point, {});
    }
  }

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

  scalar* storage_;
  long long points_;
};

// The same with storage of its own, for a number of points that is known beforehand.
template <int size>
struct second_order_maxwell_tunable_batch_storage {
  static constexpr long long needed = second_order_maxwell_tunable_batch::storage_size(size);
  alignas(64) double values[needed > 0 ? static_cast<decltype(sizeof(0))>(needed) : 1];
};

template <int size>
class second_order_maxwell_tunable_points : private second_order_maxwell_tunable_batch_storage<size>, public second_order_maxwell_tunable_batch {
 public:
  second_order_maxwell_tunable_points() noexcept : second_order_maxwell_tunable_batch(this->values, size) {}
  second_order_maxwell_tunable_points(const second_order_maxwell_tunable_points&) = delete;
  second_order_maxwell_tunable_points& operator=(const second_order_maxwell_tunable_points&) = delete;
};

}  // namespace dashpot::generated
