// General viscoelastic solid, Fig. 2e, with two values that change while it runs
//
// source: Gosline & Hayward 2009, Fig. 5; the ranges are ours
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly
// brake: makes b = 11 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': in series, B1
//   turns 100 % of the energy into heat at low frequency, and the brake follows it; in series, damper_3 turns 100
//   % of the energy into heat at low frequency, and the brake follows it
// states: what is kept of the past follows the measured position (position driven, so that a change of parameters
//   injects no energy)
// late velocity: with 0 N·s/m more in an exact brake, no lateness of the estimate alone costs passivity
// passivity: not certified for any motion, any values within their ranges between changes, however the brake
//   changes above its least command: needs 5.5652 N·s/m, counted sample by sample over a hold of up to 0.001 s, at
//   least 5.5 N·s/m is there, 0.0652 N·s/m more is missing in the brake's command
//   on an ideal device with the difference of two samples for a velocity; nothing is added for passivity
// energy: whatever the values within their ranges, no motion gets more work out of the law than stored_energy()
//   falls; rounding adds at most 6.6e-15 of the sum of the force's terms
// device: none is named: exact brake, no delay, and for velocity the difference of the last two positions over the
//   period. Pass that one: a smoother estimate is later, and of it nothing is certified here
// tunable: K1 (0 to 100 N/m), B2 (0.5 to 20 N s/m)
//   set() brings no energy in: a rise of stiffness while the tool presses stays owed until the springs can pay
//   b [N·s/m] follows B1 + damper_3
// cost of output(): at most 5 additions, multiplications and divisions
// cost of update(): at most 54 additions and multiplications; 3 numbers are kept between samples
// cost of set(): at most 154 additions, multiplications and divisions for the constants, 900 for the springs'
//   energy
// words: passive is what gives the hand no more energy than it got; certified, what is proved to be passive
//
// Written by dashpot 0.1.0 from a network with digest
// 5c194d7008f5fe1bb0e1c8f01d1156815ca3b1ae3e5903a351efbfbd8297cdca. It belongs to whoever had it
// written. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/exponential.hpp>
#include <dashpot/tunable_law.hpp>

namespace dashpot::generated {

class second_order_maxwell_tunable {
 public:
  using scalar = double;
  static constexpr scalar sample_period = 0.001;  // [s]
  static constexpr dashpot::motion port_motion = dashpot::motion::translation;

  // The part of the brake's command that is there for passivity alone: what is felt is the network and this damping.
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

  // At rest at `position` [m], springs relaxed at 0 but for the static load. A NaN or infinite one counts as 0.
  void reset(scalar position = 0) noexcept {
    last_position_ = dashpot::all_finite(position, position, position) ? position : 0;
    sampled_position_ = 0;
    sampled_position_change_ = 0;
    held_force_ = law_.reset(tables, last_position_);
    last_brake_ = steady_brake_;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s]. After a
  // non-finite input the states stay as they were and the motor's force is 0.
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

  // Takes the states to the next sample; to be called once after each output(), when the command has left.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    held_force_ = law_.update(tables, sampled_position_change_, sampled_position_);
    // u₋ = u
    last_position_ = sampled_position_;
  }

  // output() and then update(), where nothing else has to happen in between: one program, with the same bits.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    const dashpot::command<scalar> now = output(position, velocity);
    update();
    return now;
  }

  // Between samples. Injects no energy. Bit i of the result: parameter i was beyond its range and is at its
  // bound now, or it was no number and is as it was.
  unsigned set(const parameters& wanted) noexcept {
    update();
    unsigned clamped = 0;
    clamped |= dashpot::take_value(tunables[0], wanted.K1, K1_) << 0;
    clamped |= dashpot::take_value(tunables[1], wanted.B2, B2_) << 1;
    // x = T k/b
    B1_spring_2_ratio_ = dashpot::clamp_to(largest_ratio, K1_ * period / B1);
    // φ = (1 − e^(−x))/x
    B1_spring_2_kept_ = dashpot::mean_decay(B1_spring_2_ratio_);
    // α = x φ
    B1_spring_2_loss_ = B1_spring_2_ratio_ * B1_spring_2_kept_;
    // x = T k/b
    damper_3_K2_ratio_ = dashpot::clamp_to(largest_ratio, K2 * period / B2_);
    // φ = (1 − e^(−x))/x
    damper_3_K2_kept_ = dashpot::mean_decay(damper_3_K2_ratio_);
    // α = x φ
    damper_3_K2_loss_ = damper_3_K2_ratio_ * damper_3_K2_kept_;
    step_stiffness_ = law_.set(tables, {K3, K1_, B1, K2, B2_, B1_spring_2_kept_, B1_spring_2_loss_,
        damper_3_K2_kept_, damper_3_K2_loss_});
    held_force_ = law_.held(tables);
    B1_damper_3_sum_ = B1_damper_3 + B2_;
    // b follows B1 + damper_3
    steady_brake_ = B1_damper_3_sum_;
    // b∞ − b
    velocity_gain_ = no_damping - steady_brake_;
    return clamped;
  }

  // In the springs, and set free by changes of parameters, after the last update() [J].
  scalar stored_energy() const noexcept {
    // V + T: in the springs, and what changes of parameters have set free
    const scalar stored = law_.stored_energy(tables);
    return stored;
  }

 private:
  static constexpr scalar K3 = 5.0;  // as in the network [N/m]
  static constexpr scalar B1 = 5.0;  // as in the network [N s/m]
  static constexpr scalar K2 = 10.0;  // as in the network [N/m]
  static constexpr scalar largest_ratio = 1.2676506002282294e+30;  // beyond, nothing is left after a sample [1]
  static constexpr scalar period = 0.001;  // T [s]
  static constexpr scalar no_damping = 0.0;  // none [N·s/m]
  static constexpr scalar B1_damper_3 = 5.0;  // of what does not change [N s/m]
  static constexpr dashpot::tunable_range<scalar> tunables[2] = {
      {12.0, 0.0, 100.0},  // K1 [N/m]
      {6.0, 0.5, 20.0},  // B2 [N s/m]
  };
  static constexpr int springs[3] = {
      0,  // K3
      1,  // B1_spring_2
      3,  // damper_3_K2
  };
  static constexpr dashpot::tunable_part parts[3] = {
      {dashpot::tunable_kind::spring, 0, -1, -1, -1, 0, 0, 0, 0, false},  // K3
      {dashpot::tunable_kind::relaxation, 1, 2, 5, 6, 0, 0, 0, 0, false},  // B1_spring_2
      {dashpot::tunable_kind::relaxation, 2, 4, 7, 8, 0, 0, 0, 0, false},  // damper_3_K2
  };
  static constexpr dashpot::tunable_block<scalar> blocks[1] = {
      {0, 3, 0.0},
  };
  static constexpr dashpot::tunable_tables<scalar> tables = {
      1000.0, 0.9900498337491681, 6.223015277861142e-61, 0,
      {false, 0.0, 0.0}, {false, 0.0, 1.0},
      3, 3, 1, 0, 0, 0,
      springs, parts, nullptr, blocks, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
      0.0, 0.0};

  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  scalar K1_ = 12.0;  // parameter [N/m]
  scalar B2_ = 6.0;  // parameter [N s/m]
  dashpot::tunable_law<scalar, 3, 1, 1, 1, 0, 1, 0> law_;
  // a sample over the relaxation time [1]
  scalar B1_spring_2_ratio_ = dashpot::clamp_to(largest_ratio, K1_ * period / B1);
  // φ, of a displacement within a sample, what its spring has at the end [1]
  scalar B1_spring_2_kept_ = dashpot::mean_decay(B1_spring_2_ratio_);
  scalar B1_spring_2_loss_ = B1_spring_2_ratio_ * B1_spring_2_kept_;  // α, what is lost in a sample [1]
  // a sample over the relaxation time [1]
  scalar damper_3_K2_ratio_ = dashpot::clamp_to(largest_ratio, K2 * period / B2_);
  // φ, of a displacement within a sample, what its spring has at the end [1]
  scalar damper_3_K2_kept_ = dashpot::mean_decay(damper_3_K2_ratio_);
  scalar damper_3_K2_loss_ = damper_3_K2_ratio_ * damper_3_K2_kept_;  // α, what is lost in a sample [1]
  // what springs answer in a sample [N/m]
  scalar step_stiffness_ = law_.set(tables, {K3, K1_, B1, K2, B2_, B1_spring_2_kept_, B1_spring_2_loss_,
      damper_3_K2_kept_, damper_3_K2_loss_});
  scalar B1_damper_3_sum_ = B1_damper_3 + B2_;  // of these together [N s/m]
  scalar steady_brake_ = B1_damper_3_sum_;  // b of what no slip changes [N·s/m]
  scalar velocity_gain_ = no_damping - steady_brake_;  // b∞ − b [N·s/m]
  scalar held_force_ = law_.reset(tables, last_position_);  // π, what springs hold [N]
  scalar last_brake_ = steady_brake_;  // b of the sample before [N·s/m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
