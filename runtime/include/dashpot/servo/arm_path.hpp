// As command_path.hpp for two axes: what lies between reading a sample of all joints and writing a command for all
// motors and brakes. Every joint has a monitor, an estimator and a motor of its own, every brake a coil; the energy is
// summed over them. If the device states a workspace, a tip that leaves it leads to the safe command, since nothing is
// certified beyond it.
#pragma once

#include <algorithm>
#include <cmath>

#include <dashpot/actuator.hpp>
#include <dashpot/arm_device.hpp>
#include <dashpot/arm_kinematics.hpp>
#include <dashpot/arm_model.hpp>
#include <dashpot/energy/hold_observer.hpp>
#include <dashpot/servo/arm_telemetry.hpp>
#include <dashpot/servo/safety_monitor.hpp>
#include <dashpot/servo/servo_event.hpp>
#include <dashpot/servo/velocity_feed.hpp>

namespace dashpot {

struct arm_command_options {
  bool lead_coils = false;  // actuator_options::lead_coil, of every brake
};

template <class Model, class Estimators>
class arm_path {
  using scalar = typename Model::scalar;
  using estimator = std::remove_extent_t<Estimators>;

 public:
  using sample_type = arm_sample;
  using actuation_type = arm_actuation;
  using record_type = arm_telemetry_record;
  using summary_type = arm_servo_summary;

  // Requires as many brakes as the model commands.
  arm_path(Model& model, Estimators& estimators, const arm_description& arm,
           const arm_command_options& options) noexcept
      : model_(model),
        arm_(arm),
        joints_{{estimators[0], arm, 0}, {estimators[1], arm, 1}},
        brakes_{{arm, 0, options}, {arm, 1, options}, {arm, 2, options}, {arm, 3, options}},
        safe_(safe_actuation(arm)) {
    start();
  }

  void start() noexcept {
    for (joint& one : joints_) one.monitor.restart();
    demand_ = safe_;
    at_rest_ = false;
  }

  fault_report answer(unsigned missed, double asleep, device_status status, const arm_sample& sample) noexcept {
    answered_ = false;
    place_ = {};
    fault_report found = check_wake_up(missed, asleep);
    if (!found) found = check_sample(status, sample);
    if (!found && newest().is_fresh()) found = respond(sample);
    if (found) demand_ = safe_, forget_coils();
    return found;
  }

  void note_write(const arm_actuation& command, bool has_left) noexcept {
    has_left_ = has_left;
    if (has_left) sent_commands_[++commands_ % remembered] = command;
  }

  void finish() noexcept {
    if (!answered_) return;
    model_.update();
    const double duration = hold_time();
    for (unsigned j = 0; j < arm_axes; ++j) joints_[j].energy.observe(position_[j], duration);
    for (unsigned i = 0; i < arm_.brake_count; ++i) brakes_[i].energy.observe(along(i, position_), duration);
    if (!has_left_) return forget_coils();
    held_ = commands_;
    hold([](const brake& one) { return one.output.assured_damping; });
  }

  void rest() noexcept {
    for (unsigned i = 0; i < arm_.brake_count; ++i) brakes_[i].actuator.drive({safe_.brake_damping[i], 0}, 0);
  }

  fault_report check_write(device_status status) noexcept { return joints_[0].monitor.check_write(status); }

  const arm_actuation& demand() const noexcept { return demand_; }
  const arm_actuation& safe() const noexcept { return safe_; }
  bool has_answered() const noexcept { return answered_; }
  double energy() const noexcept {
    double sum = 0;
    for (const joint& one : joints_) sum += one.energy.balance();
    for (unsigned i = 0; i < arm_.brake_count; ++i) sum += brakes_[i].energy.balance();
    return sum;
  }
  double stored_at_start() const noexcept { return stored_at_start_; }
  fault_place place() const noexcept { return place_; }  // of the newest fault

  bool is_safe(const arm_actuation& applied) const noexcept {
    bool safe = true;
    for (const double torque : applied.motor_torque) safe = safe && torque == 0;
    for (unsigned i = 0; i < arm_.brake_count; ++i)
      safe = safe && std::abs(applied.brake_damping[i] - safe_.brake_damping[i]) <= 1e-6 * safe_.brake_damping[i];
    return safe;
  }

  void account(arm_servo_summary& summary) noexcept {
    for (unsigned j = 0; j < arm_axes; ++j) {
      summary.motor_clipped += joints_[j].output.motor_saturated() || joints_[j].falls_short ? 1 : 0;
      summary.lowest_positions[j] = has_moved_ ? std::min(summary.lowest_positions[j], position_[j]) : position_[j];
      summary.highest_positions[j] = has_moved_ ? std::max(summary.highest_positions[j], position_[j]) : position_[j];
      summary.largest_torques[j] = std::max(summary.largest_torques[j], std::abs(wanted_torque_[j]));
      summary.lowest_tip[j] = has_moved_ ? std::min(summary.lowest_tip[j], tip_[j]) : tip_[j];
      summary.highest_tip[j] = has_moved_ ? std::max(summary.highest_tip[j], tip_[j]) : tip_[j];
    }
    for (unsigned i = 0; i < arm_.brake_count; ++i) {
      const actuator_output<double>& output = brakes_[i].output;
      const bool is_clipped = is_less(output.brake_damping, output.brake_damping + output.damping_clipped);
      summary.brake_clipped += is_clipped || brakes_[i].falls_short ? 1 : 0;
      summary.largest_dampings[i] = std::max(summary.largest_dampings[i], wanted_damping_[i]);
    }
    const double share = kept_share_of(model_);
    summary.shed += share < 1 ? 1 : 0;
    summary.least_share = std::min(summary.least_share, share);
    has_moved_ = true;
  }

  static void describe_sent(const arm_actuation& sent, arm_telemetry_record& record) noexcept { record.sent = sent; }
  void describe(arm_telemetry_record& record) const noexcept {
    for (unsigned j = 0; j < arm_axes; ++j) {
      record.position[j] = position_[j];
      record.velocity[j] = velocity_[j];
      record.torque[j] = wanted_torque_[j];
    }
    for (unsigned i = 0; i < most_arm_brakes; ++i) record.damping[i] = wanted_damping_[i];
  }

 private:
  static constexpr unsigned remembered = 256;  // as in command_path.hpp

  struct joint {
    joint(estimator& of_this, const arm_description& arm, unsigned number) noexcept
        : feed(of_this),
          monitor(joint_of(arm, number)),
          motor(joint_of(arm, number), arm.motion()),
          energy(arm.loop().delay_samples) {}

    velocity_feed<estimator> feed;
    safety_monitor monitor;
    actuator<double> motor;
    hold_observer<double> energy;
    actuator_output<double> output;
    bool falls_short = false;  // by the newest report it made less than it was asked for
  };
  struct brake {
    brake(const arm_description& arm, unsigned number, const arm_command_options& options) noexcept
        : actuator(brake_of(arm, number), arm.motion(), {false, options.lead_coils}),
          energy(arm.loop().delay_samples, quantum(arm, number)) {}

    // The largest error of a·q if every encoder may be off by a step.
    static double quantum(const arm_description& arm, unsigned number) noexcept {
      double sum = 0;
      for (unsigned j = 0; j < arm_axes; ++j) sum += std::abs(arm.brakes[number].along[j]) * arm.joints[j].encoder.step;
      return sum;
    }

    dashpot::actuator<double> actuator;
    hold_observer<double> energy;
    actuator_output<double> output;
    double sent = 0;  // [N·m·s/rad] or [N·s/m]
    bool falls_short = false;
  };

  // What both joints share is the same in both monitors.
  safety_monitor& newest() noexcept { return joints_[0].monitor; }

  fault_report check_wake_up(unsigned missed, double asleep) noexcept {
    fault_report found;
    for (joint& one : joints_) found = one.monitor.check_wake_up(missed, asleep);
    return found;
  }

  fault_report check_sample(device_status status, const arm_sample& sample) noexcept {
    fault_report first;
    for (unsigned j = 0; j < arm_axes; ++j) {
      const fault_report found = joints_[j].monitor.check_sample(status, sample.of_joint(j));
      if (!found || first) continue;
      first = found;
      const bool is_of_all = found.kind == fault::device_error || found.kind == fault::no_data;
      place_ = is_of_all ? fault_place{} : of_joint(j);
    }
    return first;
  }

  fault_report check_workspace() noexcept {
    const arm_geometry& arm = arm_.geometry;
    for (unsigned i = 0; i < 2; ++i) {
      if (!(arm.workspace_low[i] < arm.workspace_high[i])) continue;
      const double limit = tip_[i] > arm.workspace_high[i] ? arm.workspace_high[i] : arm.workspace_low[i];
      if (tip_[i] >= arm.workspace_low[i] && tip_[i] <= arm.workspace_high[i]) continue;
      place_ = {i == 0 ? "the tip's x" : "the tip's y", true};
      return {fault::position_out_of_range, tip_[i], limit};
    }
    return {};
  }

  fault_report respond(const arm_sample& sample) noexcept {
    if (!at_rest_) rest_at(sample);
    hold_coils_over_gap();
    if (const fault_report found = check_report(sample.report)) return found;
    heed(sample.report);
    const unsigned periods = newest().periods_since_last();
    for (unsigned j = 0; j < arm_axes; ++j) {
      position_[j] = sample.position[j];
      velocity_[j] = joints_[j].feed.update(sample.of_joint(j), periods);
    }
    for (unsigned j = 0; j < arm_axes; ++j)
      if (const fault_report found = joints_[j].monitor.check_velocity(velocity_[j])) return at(j, found);
    constexpr double no_motion[arm_axes] = {};
    const arm_point tip = pose_of(arm_.geometry, position_, no_motion).tip;
    for (unsigned i = 0; i < 2; ++i) tip_[i] = tip.position[i];
    if (const fault_report found = check_workspace()) return found;
    const scalar q[arm_axes] = {static_cast<scalar>(position_[0]), static_cast<scalar>(position_[1])};
    const scalar v[arm_axes] = {static_cast<scalar>(velocity_[0]), static_cast<scalar>(velocity_[1])};
    return drive(model_.output(q, v));
  }

  template <class Commands>
  fault_report drive(const Commands& wanted) noexcept {
    for (unsigned j = 0; j < arm_axes; ++j) {
      wanted_torque_[j] = static_cast<double>(wanted.torque[j]);
      if (const fault_report found = newest().check_command(0, wanted_torque_[j])) return at(j, found);
      joints_[j].output = joints_[j].motor.drive({0, wanted_torque_[j]}, 0);
      if (const fault_report found = newest().check_command(0, joints_[j].output.motor_torque)) return at(j, found);
    }
    for (unsigned i = 0; i < arm_.brake_count; ++i) {
      wanted_damping_[i] = static_cast<double>(wanted.damping[i]);
      if (const fault_report found = newest().check_command(wanted_damping_[i], 0)) return at_brake(i, found);
      brakes_[i].sent = wanted_damping_[i];
      brakes_[i].output = brakes_[i].actuator.drive({wanted_damping_[i], 0}, 0);
    }
    const bool sheds = kept_share_of(model_) < 1;
    fault_report saturated;
    for (unsigned j = 0; j < arm_axes; ++j) {
      joint& one = joints_[j];
      const fault_report found = one.monitor.check_saturation(one.output.motor_saturated() || one.falls_short || sheds);
      if (found && !saturated) saturated = at(j, found);
    }
    if (saturated) return saturated;
    for (unsigned j = 0; j < arm_axes; ++j) demand_.motor_torque[j] = joints_[j].output.motor_torque;
    for (unsigned i = 0; i < arm_.brake_count; ++i) demand_.brake_damping[i] = brakes_[i].output.brake_damping;
    answered_ = true;
    return {};
  }

  fault_report check_report(const arm_report& report) noexcept {
    if (!report.told) return {};
    for (unsigned j = 0; j < arm_axes; ++j)
      if (const fault_report found = newest().check_report(0, report.applied.motor_torque[j])) return at(j, found);
    for (unsigned i = 0; i < arm_.brake_count; ++i)
      if (const fault_report found = newest().check_report(report.applied.brake_damping[i], 0))
        return at_brake(i, found);
    return {};
  }

  void heed(const arm_report& report) noexcept {
    for (joint& one : joints_) one.falls_short = false;
    for (brake& one : brakes_) one.falls_short = false;
    if (!report.told || report.commands_ago >= remembered || report.commands_ago >= commands_) return;
    const unsigned number = commands_ - report.commands_ago;
    const arm_actuation& asked = sent_commands_[number % remembered];
    for (unsigned j = 0; j < arm_axes; ++j) {
      const double torque = report.applied.motor_torque[j];
      joints_[j].falls_short = is_less(torque, asked.motor_torque[j]);
      joints_[j].energy.tell(number, -torque, true);
    }
    for (unsigned i = 0; i < arm_.brake_count; ++i) {
      brake& one = brakes_[i];
      one.falls_short = is_less(report.applied.brake_damping[i], asked.brake_damping[i]);
      if (one.falls_short) one.actuator.reset();
      one.energy.tell(number, 0, !one.falls_short);
    }
  }

  // As command_path.hpp.
  static bool is_less(double applied, double asked) noexcept {
    const double towards = asked < 0 ? -applied : applied, wanted = asked < 0 ? -asked : asked;
    return !(towards >= wanted * (1 - 1e-6) - 1e-30);
  }

  void rest_at(const arm_sample& sample) noexcept {
    const scalar position[arm_axes] = {static_cast<scalar>(sample.position[0]),
                                       static_cast<scalar>(sample.position[1])};
    model_.reset(position);
    stored_at_start_ = static_cast<double>(model_.stored_energy());
    for (unsigned j = 0; j < arm_axes; ++j) {
      joints_[j].feed.reset(sample.of_joint(j));
      joints_[j].energy.reset(sample.position[j]);
    }
    for (unsigned i = 0; i < arm_.brake_count; ++i) brakes_[i].energy.reset(along(i, sample.position));
    at_rest_ = true;
  }

  // What is certain of a brake over a hold of several periods is the least of what is certain over each.
  void hold_coils_over_gap() noexcept {
    const unsigned periods = newest().periods_since_last();
    if (periods < 2) return;
    if (periods > remembered) forget_coils();
    hold([periods](brake& one) {
      double assured = periods > remembered ? 0 : one.output.assured_damping;
      for (unsigned period = 1; period < periods && period < remembered; ++period)
        assured = std::min(assured, one.actuator.drive({one.sent, 0}, 0).assured_damping);
      return assured;
    });
  }

  template <class Assured>
  void hold(Assured assured) noexcept {
    for (joint& one : joints_) one.energy.hold(one.output.applied_force, 0, held_);
    for (unsigned i = 0; i < arm_.brake_count; ++i) brakes_[i].energy.hold(0, assured(brakes_[i]), held_);
  }

  void forget_coils() noexcept {
    for (brake& one : brakes_) one.actuator.reset();
  }

  double along(unsigned number, const double (&q)[arm_axes]) const noexcept {
    return arm_.brakes[number].along[0] * q[0] + arm_.brakes[number].along[1] * q[1];
  }

  double hold_time() noexcept { return newest().periods_since_last() * arm_.loop().sample_period; }

  static constexpr fault_place of_joint(unsigned j) noexcept { return {j == 0 ? "joint 1" : "joint 2", false}; }
  fault_report at(unsigned j, const fault_report& found) noexcept {
    place_ = of_joint(j);
    return found;
  }
  fault_report at_brake(unsigned i, const fault_report& found) noexcept {
    constexpr const char* names[most_arm_brakes] = {"brake 1", "brake 2", "brake 3", "brake 4"};
    place_ = {names[i], false};
    return found;
  }

  Model& model_;
  arm_description arm_;
  joint joints_[arm_axes];
  brake brakes_[most_arm_brakes];

  arm_actuation sent_commands_[remembered];  // by number
  unsigned commands_ = 0;                    // that have left, wrapping around
  unsigned held_ = 0;                        // the newest of the model's among them
  arm_actuation safe_;
  arm_actuation demand_;
  double wanted_torque_[arm_axes] = {};          // by the model, opposing +q
  double wanted_damping_[most_arm_brakes] = {};  //
  double position_[arm_axes] = {};               // [rad] or [m]
  double velocity_[arm_axes] = {};               // [rad/s] or [m/s]
  double tip_[2] = {};                           // [m]
  double stored_at_start_ = 0;                   // [J]
  fault_place place_;
  bool at_rest_ = false;
  bool answered_ = false;
  bool has_left_ = false;   // the newest command
  bool has_moved_ = false;  // the summary has seen a position
};

}  // namespace dashpot
