// Tissue that relaxes as a power of time: a springpot whose stiffness changes while it runs, beside a spring
//
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly
// brake: makes b = 1625.577561857746 N·s/m of damping, and the motor the rest of the force; by the rule 'paper':
//   in series, muscle_damper_1 turns 100 % of the energy into heat at low frequency, and the brake follows it; in
//   series, muscle_damper_2 turns 100 % of the energy into heat at low frequency, and the brake follows it; in
//   series, muscle_damper_3 turns 100 % of the energy into heat at low frequency, and the brake follows it; in
//   series, muscle_damper_4 turns 100 % of the energy into heat at low frequency, and the brake follows it; and 1
//   more series connections likewise
// states: what is kept of the past follows the measured position (position driven, so that a change of parameters
//   injects no energy)
// late velocity: with 0 N·s/m more in an exact brake, no lateness of the estimate alone costs passivity
// passivity: not certified for any motion, any values within their ranges between changes, however the brake
//   changes above its least command: needs 1.78601 N·s/m, counted sample by sample over a hold of up to 0.001 s,
//   at least 0 N·s/m is there, 1.78601 N·s/m more is missing in the brake's command
//   on an ideal device with the difference of two samples for a velocity; nothing is added for passivity
// energy: whatever the values within their ranges, no motion gets more work out of the law than stored_energy()
//   falls; rounding adds at most 1.3e-14 of the sum of the force's terms
// device: none is named: exact brake, no delay, and for velocity the difference of the last two positions over the
//   period. Pass that one: a smoother estimate is later, and of it nothing is certified here
// tunable: K (0 to 400 N/m)
//   set() brings no energy in: a rise of stiffness while the tool presses stays owed until the springs can pay
//   b [N·s/m] follows muscle_damper_1 + muscle_damper_2 + muscle_damper_3 + muscle_damper_4 + muscle_damper_5
// cost of output(): at most 5 additions, multiplications and divisions
// cost of update(): at most 111 additions and multiplications; 6 numbers are kept between samples
// cost of set(): at most 401 additions, multiplications and divisions for the constants, 1674 for the springs'
//   energy
// words: passive is what gives the hand no more energy than it got; certified, what is proved to be passive
//
// Written by dashpot 0.1.0 from a network with digest
// ad65d63c24093f1299b3ee1f326d3cb11e6151cf24830b048ab36de99b135cf8. It belongs to whoever had it
// written. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/exponential.hpp>
#include <dashpot/tunable_law.hpp>

namespace dashpot::generated {

class springpot_tunable {
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
    scalar K = 120.0;  // 0 to 400 [N/m]
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
    // x = T k/b
    muscle_spring_1_muscle_damper_1_ratio_ = muscle_damper_1_ > 0 ? dashpot::clamp_to(largest_ratio,
        muscle_spring_1_ * period / muscle_damper_1_) : (muscle_spring_1_ > 0 ? largest_ratio : zero);
    // φ = (1 − e^(−x))/x
    muscle_spring_1_muscle_damper_1_kept_ = dashpot::mean_decay(muscle_spring_1_muscle_damper_1_ratio_);
    // α = x φ
    muscle_spring_1_muscle_damper_1_loss_ = muscle_spring_1_muscle_damper_1_ratio_ *
        muscle_spring_1_muscle_damper_1_kept_;
    // x = T k/b
    muscle_spring_2_muscle_damper_2_ratio_ = muscle_damper_2_ > 0 ? dashpot::clamp_to(largest_ratio,
        muscle_spring_2_ * period / muscle_damper_2_) : (muscle_spring_2_ > 0 ? largest_ratio : zero);
    // φ = (1 − e^(−x))/x
    muscle_spring_2_muscle_damper_2_kept_ = dashpot::mean_decay(muscle_spring_2_muscle_damper_2_ratio_);
    // α = x φ
    muscle_spring_2_muscle_damper_2_loss_ = muscle_spring_2_muscle_damper_2_ratio_ *
        muscle_spring_2_muscle_damper_2_kept_;
    // x = T k/b
    muscle_spring_3_muscle_damper_3_ratio_ = muscle_damper_3_ > 0 ? dashpot::clamp_to(largest_ratio,
        muscle_spring_3_ * period / muscle_damper_3_) : (muscle_spring_3_ > 0 ? largest_ratio : zero);
    // φ = (1 − e^(−x))/x
    muscle_spring_3_muscle_damper_3_kept_ = dashpot::mean_decay(muscle_spring_3_muscle_damper_3_ratio_);
    // α = x φ
    muscle_spring_3_muscle_damper_3_loss_ = muscle_spring_3_muscle_damper_3_ratio_ *
        muscle_spring_3_muscle_damper_3_kept_;
    // x = T k/b
    muscle_spring_4_muscle_damper_4_ratio_ = muscle_damper_4_ > 0 ? dashpot::clamp_to(largest_ratio,
        muscle_spring_4_ * period / muscle_damper_4_) : (muscle_spring_4_ > 0 ? largest_ratio : zero);
    // φ = (1 − e^(−x))/x
    muscle_spring_4_muscle_damper_4_kept_ = dashpot::mean_decay(muscle_spring_4_muscle_damper_4_ratio_);
    // α = x φ
    muscle_spring_4_muscle_damper_4_loss_ = muscle_spring_4_muscle_damper_4_ratio_ *
        muscle_spring_4_muscle_damper_4_kept_;
    // x = T k/b
    muscle_spring_5_muscle_damper_5_ratio_ = muscle_damper_5_ > 0 ? dashpot::clamp_to(largest_ratio,
        muscle_spring_5_ * period / muscle_damper_5_) : (muscle_spring_5_ > 0 ? largest_ratio : zero);
    // φ = (1 − e^(−x))/x
    muscle_spring_5_muscle_damper_5_kept_ = dashpot::mean_decay(muscle_spring_5_muscle_damper_5_ratio_);
    // α = x φ
    muscle_spring_5_muscle_damper_5_loss_ = muscle_spring_5_muscle_damper_5_ratio_ *
        muscle_spring_5_muscle_damper_5_kept_;
    step_stiffness_ = law_.set(tables, {rest, muscle_spring_1_, muscle_damper_1_, muscle_spring_2_,
        muscle_damper_2_, muscle_spring_3_, muscle_damper_3_, muscle_spring_4_, muscle_damper_4_, muscle_spring_5_,
        muscle_damper_5_, muscle_spring_1_muscle_damper_1_kept_, muscle_spring_1_muscle_damper_1_loss_,
        muscle_spring_2_muscle_damper_2_kept_, muscle_spring_2_muscle_damper_2_loss_,
        muscle_spring_3_muscle_damper_3_kept_, muscle_spring_3_muscle_damper_3_loss_,
        muscle_spring_4_muscle_damper_4_kept_, muscle_spring_4_muscle_damper_4_loss_,
        muscle_spring_5_muscle_damper_5_kept_, muscle_spring_5_muscle_damper_5_loss_});
    held_force_ = law_.held(tables);
    muscle_damper_1_to_muscle_damper_5_sum_ = muscle_damper_1_to_muscle_damper_5_share * K_ +
        muscle_damper_1_to_muscle_damper_5_share_2 * K_ + muscle_damper_1_to_muscle_damper_5_share_3 * K_ +
        muscle_damper_1_to_muscle_damper_5_share_4 * K_ + muscle_damper_1_to_muscle_damper_5_share_5 * K_;
    // b follows muscle_damper_1 + muscle_damper_2 + muscle_damper_3 + muscle_damper_4 + muscle_damper_5
    steady_brake_ = muscle_damper_1_to_muscle_damper_5_sum_;
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
  static constexpr scalar rest = 40.0;  // as in the network [N/m]
  static constexpr scalar muscle_spring_1_share = 0.5529489387983896;  // of K [1]
  static constexpr scalar muscle_damper_1_share = 12.628169563370793;  // of K [1]
  static constexpr scalar muscle_spring_2_share = 0.4443552938125914;  // of K [1]
  static constexpr scalar muscle_damper_2_share = 0.6863981165441095;  // of K [1]
  static constexpr scalar muscle_spring_3_share = 0.8014436491467305;  // of K [1]
  static constexpr scalar muscle_damper_3_share = 0.1733444489849207;  // of K [1]
  static constexpr scalar muscle_spring_4_share = 1.4454917758412602;  // of K [1]
  static constexpr scalar muscle_damper_4_share = 0.043776778038339514;  // of K [1]
  static constexpr scalar muscle_spring_5_share = 4.501420953574023;  // of K [1]
  static constexpr scalar muscle_damper_5_share = 0.014790775209721498;  // of K [1]
  static constexpr scalar largest_ratio = 1.2676506002282294e+30;  // beyond, nothing is left after a sample [1]
  static constexpr scalar period = 0.001;  // T [s]
  static constexpr scalar zero = 0.0;  // nothing [1]
  static constexpr scalar no_damping = 0.0;  // none [N·s/m]
  static constexpr scalar muscle_damper_1_to_muscle_damper_5_share = 12.628169563370793;  // of K [1]
  static constexpr scalar muscle_damper_1_to_muscle_damper_5_share_2 = 0.6863981165441095;  // of K [1]
  static constexpr scalar muscle_damper_1_to_muscle_damper_5_share_3 = 0.1733444489849207;  // of K [1]
  static constexpr scalar muscle_damper_1_to_muscle_damper_5_share_4 = 0.043776778038339514;  // of K [1]
  static constexpr scalar muscle_damper_1_to_muscle_damper_5_share_5 = 0.014790775209721498;  // of K [1]
  static constexpr dashpot::tunable_range<scalar> tunables[1] = {
      {120.0, 0.0, 400.0},  // K [N/m]
  };
  static constexpr int springs[6] = {
      0,  // rest
      1,  // muscle_spring_1_muscle_damper_1
      3,  // muscle_spring_2_muscle_damper_2
      5,  // muscle_spring_3_muscle_damper_3
      7,  // muscle_spring_4_muscle_damper_4
      9,  // muscle_spring_5_muscle_damper_5
  };
  static constexpr dashpot::tunable_part parts[6] = {
      {dashpot::tunable_kind::spring, 0, -1, -1, -1, 0, 0, 0, 0, false},  // rest
      {dashpot::tunable_kind::relaxation, 1, 2, 11, 12, 0, 0, 0, 0, false},  // muscle_spring_1_muscle_damper_1
      {dashpot::tunable_kind::relaxation, 2, 4, 13, 14, 0, 0, 0, 0, false},  // muscle_spring_2_muscle_damper_2
      {dashpot::tunable_kind::relaxation, 3, 6, 15, 16, 0, 0, 0, 0, false},  // muscle_spring_3_muscle_damper_3
      {dashpot::tunable_kind::relaxation, 4, 8, 17, 18, 0, 0, 0, 0, false},  // muscle_spring_4_muscle_damper_4
      {dashpot::tunable_kind::relaxation, 5, 10, 19, 20, 0, 0, 0, 0, false},  // muscle_spring_5_muscle_damper_5
  };
  static constexpr dashpot::tunable_block<scalar> blocks[1] = {
      {0, 6, 0.0},
  };
  static constexpr dashpot::tunable_tables<scalar> tables = {
      1000.0, 0.9900498337491681, 6.223015277861142e-61, 0,
      {false, 0.0, 0.0}, {false, 0.0, 1.0},
      6, 6, 1, 0, 0, 0,
      springs, parts, nullptr, blocks, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
      0.0, 0.0};

  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  scalar K_ = 120.0;  // parameter [N/m]
  dashpot::tunable_law<scalar, 6, 1, 1, 1, 0, 1, 0> law_;
  scalar muscle_spring_1_ = muscle_spring_1_share * K_;  // by its share [N/m]
  scalar muscle_damper_1_ = muscle_damper_1_share * K_;  // by its share [N s/m]
  scalar muscle_spring_2_ = muscle_spring_2_share * K_;  // by its share [N/m]
  scalar muscle_damper_2_ = muscle_damper_2_share * K_;  // by its share [N s/m]
  scalar muscle_spring_3_ = muscle_spring_3_share * K_;  // by its share [N/m]
  scalar muscle_damper_3_ = muscle_damper_3_share * K_;  // by its share [N s/m]
  scalar muscle_spring_4_ = muscle_spring_4_share * K_;  // by its share [N/m]
  scalar muscle_damper_4_ = muscle_damper_4_share * K_;  // by its share [N s/m]
  scalar muscle_spring_5_ = muscle_spring_5_share * K_;  // by its share [N/m]
  scalar muscle_damper_5_ = muscle_damper_5_share * K_;  // by its share [N s/m]
  // a sample over the relaxation time [1]
  scalar muscle_spring_1_muscle_damper_1_ratio_ = muscle_damper_1_ > 0 ? dashpot::clamp_to(largest_ratio,
      muscle_spring_1_ * period / muscle_damper_1_) : (muscle_spring_1_ > 0 ? largest_ratio : zero);
  // φ, of a displacement within a sample, what its spring has at the end [1]
  scalar muscle_spring_1_muscle_damper_1_kept_ = dashpot::mean_decay(muscle_spring_1_muscle_damper_1_ratio_);
  // α, what is lost in a sample [1]
  scalar muscle_spring_1_muscle_damper_1_loss_ = muscle_spring_1_muscle_damper_1_ratio_ *
      muscle_spring_1_muscle_damper_1_kept_;
  // a sample over the relaxation time [1]
  scalar muscle_spring_2_muscle_damper_2_ratio_ = muscle_damper_2_ > 0 ? dashpot::clamp_to(largest_ratio,
      muscle_spring_2_ * period / muscle_damper_2_) : (muscle_spring_2_ > 0 ? largest_ratio : zero);
  // φ, of a displacement within a sample, what its spring has at the end [1]
  scalar muscle_spring_2_muscle_damper_2_kept_ = dashpot::mean_decay(muscle_spring_2_muscle_damper_2_ratio_);
  // α, what is lost in a sample [1]
  scalar muscle_spring_2_muscle_damper_2_loss_ = muscle_spring_2_muscle_damper_2_ratio_ *
      muscle_spring_2_muscle_damper_2_kept_;
  // a sample over the relaxation time [1]
  scalar muscle_spring_3_muscle_damper_3_ratio_ = muscle_damper_3_ > 0 ? dashpot::clamp_to(largest_ratio,
      muscle_spring_3_ * period / muscle_damper_3_) : (muscle_spring_3_ > 0 ? largest_ratio : zero);
  // φ, of a displacement within a sample, what its spring has at the end [1]
  scalar muscle_spring_3_muscle_damper_3_kept_ = dashpot::mean_decay(muscle_spring_3_muscle_damper_3_ratio_);
  // α, what is lost in a sample [1]
  scalar muscle_spring_3_muscle_damper_3_loss_ = muscle_spring_3_muscle_damper_3_ratio_ *
      muscle_spring_3_muscle_damper_3_kept_;
  // a sample over the relaxation time [1]
  scalar muscle_spring_4_muscle_damper_4_ratio_ = muscle_damper_4_ > 0 ? dashpot::clamp_to(largest_ratio,
      muscle_spring_4_ * period / muscle_damper_4_) : (muscle_spring_4_ > 0 ? largest_ratio : zero);
  // φ, of a displacement within a sample, what its spring has at the end [1]
  scalar muscle_spring_4_muscle_damper_4_kept_ = dashpot::mean_decay(muscle_spring_4_muscle_damper_4_ratio_);
  // α, what is lost in a sample [1]
  scalar muscle_spring_4_muscle_damper_4_loss_ = muscle_spring_4_muscle_damper_4_ratio_ *
      muscle_spring_4_muscle_damper_4_kept_;
  // a sample over the relaxation time [1]
  scalar muscle_spring_5_muscle_damper_5_ratio_ = muscle_damper_5_ > 0 ? dashpot::clamp_to(largest_ratio,
      muscle_spring_5_ * period / muscle_damper_5_) : (muscle_spring_5_ > 0 ? largest_ratio : zero);
  // φ, of a displacement within a sample, what its spring has at the end [1]
  scalar muscle_spring_5_muscle_damper_5_kept_ = dashpot::mean_decay(muscle_spring_5_muscle_damper_5_ratio_);
  // α, what is lost in a sample [1]
  scalar muscle_spring_5_muscle_damper_5_loss_ = muscle_spring_5_muscle_damper_5_ratio_ *
      muscle_spring_5_muscle_damper_5_kept_;
  // what springs answer in a sample [N/m]
  scalar step_stiffness_ = law_.set(tables, {rest, muscle_spring_1_, muscle_damper_1_, muscle_spring_2_,
      muscle_damper_2_, muscle_spring_3_, muscle_damper_3_, muscle_spring_4_, muscle_damper_4_, muscle_spring_5_,
      muscle_damper_5_, muscle_spring_1_muscle_damper_1_kept_, muscle_spring_1_muscle_damper_1_loss_,
      muscle_spring_2_muscle_damper_2_kept_, muscle_spring_2_muscle_damper_2_loss_,
      muscle_spring_3_muscle_damper_3_kept_, muscle_spring_3_muscle_damper_3_loss_,
      muscle_spring_4_muscle_damper_4_kept_, muscle_spring_4_muscle_damper_4_loss_,
      muscle_spring_5_muscle_damper_5_kept_, muscle_spring_5_muscle_damper_5_loss_});
  // of these together [N s/m]
  scalar muscle_damper_1_to_muscle_damper_5_sum_ = muscle_damper_1_to_muscle_damper_5_share * K_ +
      muscle_damper_1_to_muscle_damper_5_share_2 * K_ + muscle_damper_1_to_muscle_damper_5_share_3 * K_ +
      muscle_damper_1_to_muscle_damper_5_share_4 * K_ + muscle_damper_1_to_muscle_damper_5_share_5 * K_;
  scalar steady_brake_ = muscle_damper_1_to_muscle_damper_5_sum_;  // b of what no slip changes [N·s/m]
  scalar velocity_gain_ = no_damping - steady_brake_;  // b∞ − b [N·s/m]
  scalar held_force_ = law_.reset(tables, last_position_);  // π, what springs hold [N]
  scalar last_brake_ = steady_brake_;  // b of the sample before [N·s/m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
