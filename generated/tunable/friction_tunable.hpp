// Presliding and Coulomb friction beside a viscous drag, all of which change while it runs
//
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly, but for
//   samples in which a slip or a contact changes
// brake: makes b = 12 N·s/m of damping, behind slips also what follows, and the motor the rest of the force; by
//   the rule 'faithful': no device to be faithful on, so the paper's rule: dampers at the tool in parallel add
// behind friction: velocity-free, parameters change while it runs; b is that of their default values; b = 0 N·s/m
//   stuck, 0 sliding
// states: what is kept of the past follows the measured position (position driven, so that a change of parameters
//   injects no energy)
// late velocity: with 0 N·s/m more in an exact brake, no lateness of the estimate alone costs passivity
// passivity: not certified for any motion, whatever slides, sticks, touches or lets go, any values within their
//   ranges between changes, however the brake changes above its least command: needs 2.5 N·s/m, counted sample by
//   sample over a hold of up to 0.001 s, at least 0 N·s/m is there, 2.5 N·s/m more is missing in the brake's
//   command
//   on an ideal device with the difference of two samples for a velocity; nothing is added for passivity
// energy: whatever the values within their ranges, no motion gets more work out of the law than stored_energy()
//   falls; rounding adds at most 1.1e-14 of the sum of the force's terms
// device: none is named: exact brake, no delay, and for velocity the difference of the last two positions over the
//   period. Pass that one: a smoother estimate is later, and of it nothing is certified here
// tunable: yield (0 to 5 N), presliding (200 to 5000 N/m), drag (0 to 40 N s/m)
//   set() brings no energy in: a rise of stiffness while the tool presses stays owed until the springs can pay
//   b [N·s/m] follows damper_3
// cost of output(): at most 82 additions, multiplications and divisions
// cost of update(): at most 21 additions and multiplications; 1 numbers are kept between samples
// cost of set(): at most 24 additions, multiplications and divisions for the constants, 384 for the springs'
//   energy
// words: passive is what gives the hand no more energy than it got; certified, what is proved to be passive
//
// Written by dashpot 0.1.0 from a network with digest
// c86fcb8b7c393e3b623d21078d88e80af59e3eaf3833b10700b69af0c86379ba. It belongs to whoever had it
// written. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/tunable_law.hpp>

namespace dashpot::generated {

class friction_tunable {
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
    scalar yield = 1.5;  // 0 to 5 [N]
    scalar presliding = 2000.0;  // 200 to 5000 [N/m]
    scalar drag = 12.0;  // 0 to 40 [N s/m]
  };

  // At rest at `position` [m], springs relaxed at 0 but for the static load. A NaN or infinite one counts as 0.
  void reset(scalar position = 0) noexcept {
    last_position_ = dashpot::all_finite(position, position, position) ? position : 0;
    sampled_position_ = 0;
    sampled_position_change_ = 0;
    held_force_ = law_.reset(tables, last_position_);
    resting_brake_ = law_.resting_brake(tables, brake_left_);
    last_brake_ = steady_brake_ + resting_brake_;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s]. After a
  // non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    // σ of all slips
    const scalar slips_force = law_.slip(tables, position_change);
    // b of the slips' regime
    const auto& slip_brake = law_.slip_brake(tables, position, brake_left_);
    const scalar slips_feedthrough = slip_brake.now;
    const scalar slips_brake = slip_brake.damping;
    // m = f − b u̇
    const scalar force = step_stiffness_ * position_change + held_force_ +
        slips_force - slips_feedthrough * position_change + velocity_gain_ * velocity;
    // b
    const scalar brake = steady_brake_ + slips_brake;
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
    clamped |= dashpot::take_value(tunables[0], wanted.yield, yield_) << 0;
    clamped |= dashpot::take_value(tunables[1], wanted.presliding, presliding_) << 1;
    clamped |= dashpot::take_value(tunables[2], wanted.drag, drag_) << 2;
    step_stiffness_ = law_.set(tables, {drag_, presliding_, yield_});
    held_force_ = law_.held(tables);
    // b follows damper_3
    steady_brake_ = drag_;
    // b∞ − b
    velocity_gain_ = drag_ - steady_brake_;
    brake_left_ = max_damping - steady_brake_;
    return clamped;
  }

  // In the springs, and set free by changes of parameters, after the last update() [J].
  scalar stored_energy() const noexcept {
    // V + T: in the springs, and what changes of parameters have set free
    const scalar stored = law_.stored_energy(tables);
    return stored;
  }

 private:
  static constexpr scalar max_damping = 1.7976931348623157e+308;  // what the brake can give [N·s/m]
  static constexpr dashpot::tunable_range<scalar> tunables[3] = {
      {1.5, 0.0, 5.0},  // yield [N]
      {2000.0, 200.0, 5000.0},  // presliding [N/m]
      {12.0, 0.0, 40.0},  // drag [N s/m]
  };
  static constexpr int springs[1] = {
      1,  // spring_2
  };
  static constexpr dashpot::tunable_part parts[2] = {
      {dashpot::tunable_kind::damper, -1, 0, -1, -1, 0, 0, 0, 0, false},
      {dashpot::tunable_kind::spring, 0, -1, -1, -1, 0, 0, 0, 0, true},  // spring_2
  };
  static constexpr dashpot::tunable_block<scalar> blocks[2] = {
      {0, 1, 0.0},
      {1, 1, 0.0002980232238769531},
  };
  static constexpr int cuts[1] = {2};
  static constexpr dashpot::tunable_yield<scalar> yields[1] = {
      {0, 1, 2.980232238769531e-07},
  };
  static constexpr dashpot::tunable_coupling couplings[1] = {
      {0, 3, 1, 0, 0},
  };
  static constexpr dashpot::slip_node<scalar> nodes[3] = {
      {dashpot::slip_part::series, 1, 2, 1, 0, 0, 0, 0, 0},
      {dashpot::slip_part::block, 0, 0, 0, 0, 0, 0, 0, 0},
      {dashpot::slip_part::slip, 0, 0, 1, 0, 4, 0, 0, 0},
  };
  static constexpr dashpot::tunable_tables<scalar> tables = {
      1000.0, 0.9900498337491681, 6.223015277861142e-61, -1,
      {false, 0.0, 0.0}, {true, 0.0, 1.0},
      1, 2, 2, 1, 1, 0,
      springs, parts, nullptr, blocks, cuts, yields, couplings, nodes, nullptr, nullptr, nullptr,
      0.0, 0.0};

  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  scalar yield_ = 1.5;  // parameter [N]
  scalar presliding_ = 2000.0;  // parameter [N/m]
  scalar drag_ = 12.0;  // parameter [N s/m]
  dashpot::tunable_law<scalar, 1, 1, 2, 3, 1, 8, 0> law_;
  // what springs answer in a sample [N/m]
  scalar step_stiffness_ = law_.set(tables, {drag_, presliding_, yield_});
  scalar steady_brake_ = drag_;  // b of what no slip changes [N·s/m]
  scalar velocity_gain_ = drag_ - steady_brake_;  // b∞ − b [N·s/m]
  scalar brake_left_ = max_damping - steady_brake_;  // what the brake has left for slips [N·s/m]
  scalar held_force_ = law_.reset(tables, last_position_);  // π, what springs hold [N]
  scalar resting_brake_ = law_.resting_brake(tables, brake_left_);  // b of what is behind slips that hold [N·s/m]
  scalar last_brake_ = steady_brake_ + resting_brake_;  // b of the sample before [N·s/m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
