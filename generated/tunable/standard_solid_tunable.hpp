// A Kelvin element in series with a spring: a tunable that mixes with its relaxation
//
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly
// brake: makes b = 8 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': in series,
//   (spring_1 | B1) turns 100 % of the energy into heat at low frequency, and the brake follows it
// states: what is kept of the past follows the measured position (position driven, so that a change of parameters
//   injects no energy)
// late velocity: with 0 N·s/m more in an exact brake, no lateness of the estimate alone costs passivity
// passivity: not certified for any motion, any values within their ranges between changes, however the brake
//   changes above its least command: needs 16.4 N·s/m, counted sample by sample over a hold of up to 0.001 s, at
//   least 8 N·s/m is there, 8.4 N·s/m more is missing in the brake's command
//   on an ideal device with the difference of two samples for a velocity; nothing is added for passivity
// energy: whatever the values within their ranges, no motion gets more work out of the law than stored_energy()
//   falls; rounding adds at most 5.7e-15 of the sum of the force's terms
// device: none is named: exact brake, no delay, and for velocity the difference of the last two positions over the
//   period. Pass that one: a smoother estimate is later, and of it nothing is certified here
// tunable: K1 (50 to 800 N/m)
//   set() brings no energy in: a rise of stiffness while the tool presses stays owed until the springs can pay
//   b [N·s/m] follows B1
//   by backward Euler, since their relaxations mix with a tunable or at several slips: spring_1, B1, K2
// cost of output(): at most 5 additions, multiplications and divisions
// cost of update(): at most 46 additions and multiplications; 2 numbers are kept between samples
// cost of set(): at most 55 additions, multiplications and divisions for the constants, 642 for the springs'
//   energy
// words: passive is what gives the hand no more energy than it got; certified, what is proved to be passive
//
// Written by dashpot 0.1.0 from a network with digest
// b57d94149fbc717b05578019de4d32e026e1596c4f3a169d2568b21102a47de3. It belongs to whoever had it
// written. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/tunable_law.hpp>

namespace dashpot::generated {

class standard_solid_tunable {
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
    scalar K1 = 200.0;  // 50 to 800 [N/m]
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
    springs_stiffness_ = law_.set(tables, {B1, K1_, K2});
    held_force_ = law_.held(tables);
    const auto& meshes = law_.meshes(tables);
    mesh_stiffness_ = meshes.stiffness;
    mesh_feedthrough_ = meshes.feedthrough;
    step_stiffness_ = springs_stiffness_ + mesh_stiffness_;
    // b follows B1
    steady_brake_ = B1;
    // b∞ − b
    velocity_gain_ = mesh_feedthrough_ - steady_brake_;
    return clamped;
  }

  // In the springs, and set free by changes of parameters, after the last update() [J].
  scalar stored_energy() const noexcept {
    // V + T: in the springs, and what changes of parameters have set free
    const scalar stored = law_.stored_energy(tables);
    return stored;
  }

 private:
  static constexpr scalar B1 = 8.0;  // as in the network [N s/m]
  static constexpr scalar K2 = 600.0;  // as in the network [N/m]
  static constexpr dashpot::tunable_range<scalar> tunables[1] = {
      {200.0, 50.0, 800.0},  // K1 [N/m]
  };
  static constexpr int springs[2] = {
      1,  // spring_1
      2,  // K2
  };
  static constexpr dashpot::tunable_part parts[1] = {
      {dashpot::tunable_kind::mesh, -1, -1, -1, -1, 0, 1, 0, 3, false},
  };
  static constexpr dashpot::tunable_edge edges[3] = {
      {-1, 0, -1, 0},
      {-1, 0, 0, -1},
      {0, -2, 1, -1},
  };
  static constexpr dashpot::tunable_block<scalar> blocks[1] = {
      {0, 1, 0.0},
  };
  static constexpr dashpot::tunable_tables<scalar> tables = {
      1000.0, 0.9900498337491681, 6.223015277861142e-61, -1,
      {false, 0.0, 0.0}, {false, 0.0, 1.0},
      2, 1, 1, 0, 0, 0,
      springs, parts, edges, blocks, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
      0.0, 0.0};

  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  scalar K1_ = 200.0;  // parameter [N/m]
  dashpot::tunable_law<scalar, 2, 1, 1, 1, 0, 1, 0> law_;
  scalar springs_stiffness_ = law_.set(tables, {B1, K1_, K2});  // what springs answer in a sample [N/m]
  scalar mesh_stiffness_ = law_.meshes(tables).stiffness;  // what meshes answer in a sample [N/m]
  scalar mesh_feedthrough_ = law_.meshes(tables).feedthrough;  // b∞ of the meshes [N·s/m]
  scalar step_stiffness_ = springs_stiffness_ + mesh_stiffness_;  // what all answer in a sample [N/m]
  scalar steady_brake_ = B1;  // b of what no slip changes [N·s/m]
  scalar velocity_gain_ = mesh_feedthrough_ - steady_brake_;  // b∞ − b [N·s/m]
  scalar held_force_ = law_.reset(tables, last_position_);  // π, what springs hold [N]
  scalar last_brake_ = steady_brake_;  // b of the sample before [N·s/m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
