// What lies between reading a sample and writing a command, and nothing else: safety checks, velocity estimate, model,
// actuator. No heap, lock, system call or exception; what can wait until the command has left is in finish().
#pragma once

#include <algorithm>
#include <cmath>

#include <dashpot/actuator.hpp>
#include <dashpot/command.hpp>
#include <dashpot/device.hpp>
#include <dashpot/model.hpp>
#include <dashpot/servo/energy_account.hpp>
#include <dashpot/servo/safety_monitor.hpp>
#include <dashpot/servo/servo_event.hpp>
#include <dashpot/servo/servo_summary.hpp>
#include <dashpot/servo/telemetry_record.hpp>
#include <dashpot/servo/velocity_feed.hpp>

namespace dashpot {

// What may happen to the model's command on its way to the device.
struct command_options {
  actuator_options actuator;
  energy_policy energy = energy_policy::observe;
};

template <class Model, class Estimator>
class command_path {
  using scalar = typename Model::scalar;

 public:
  using sample_type = device_sample;
  using actuation_type = actuation;
  using record_type = telemetry_record;
  using summary_type = servo_summary;

  // Requires can_drive(device, network).
  command_path(Model& model, Estimator& estimator, const device_description& device, motion network,
               const command_options& options) noexcept
      : model_(model),
        feed_(estimator),
        monitor_(device),
        actuator_(device, network, options.actuator),
        energy_(device, actuator_.gear(), options.energy),
        sample_period_(device.loop.sample_period),
        safe_{0, device.brake.safe_damping} {
    start();
  }

  // The next fresh sample is where model and estimator are at rest.
  void start() noexcept {
    monitor_.restart();
    demand_ = safe_;
    at_rest_ = false;
  }

  // One period: the command in demand() is the model's for this sample, the one before where the sample is not fresh,
  // and the safe one where a fault is returned.
  fault_report answer(unsigned missed, double asleep, device_status status, const device_sample& sample) noexcept {
    answered_ = false;
    fault_report found = monitor_.check_wake_up(missed, asleep);
    if (!found) found = monitor_.check_sample(status, sample);
    if (!found && monitor_.is_fresh()) found = respond(sample);
    if (found) demand_ = safe_, forget_coil();
    return found;
  }

  // With every command that was written, in any state, before finish() or rest(). What could not be sent is not in
  // force.
  void note_write(const actuation& command, bool has_left) noexcept {
    has_left_ = has_left;
    if (has_left) sent_commands_[++commands_ % remembered] = command;
  }

  // After the command has left.
  void finish() noexcept {
    if (!answered_) return;
    model_.update();
    energy_.observe(position_, hold_time());
    if (!has_left_) return forget_coil();
    held_ = commands_;
    energy_.hold(output_.applied_force, output_.assured_damping, held_);
  }

  // In place of answer() and finish(), in a period in which safe() was sent: the brake's coil follows it.
  void rest() noexcept { actuator_.drive({actuator_.gear().tool_damping(safe_.brake_damping), 0}, 0); }

  fault_report check_write(device_status status) noexcept { return monitor_.check_write(status); }

  const actuation& demand() const noexcept { return demand_; }
  const actuation& safe() const noexcept { return safe_; }
  bool has_answered() const noexcept { return answered_; }      // this period's sample reached the model
  double energy() const noexcept { return energy_.balance(); }  // taken from the tool since start(), at least [J]
  double stored_at_start() const noexcept { return stored_at_start_; }  // by the model [J]
  static fault_place place() noexcept { return {}; }                    // of a fault: there is one axis

  // Whether what a device applies is the safe command, to the rounding of one in single precision.
  bool is_safe(const actuation& applied) const noexcept {
    const double off = applied.brake_damping - safe_.brake_damping, rounding = 1e-6 * safe_.brake_damping;
    return applied.motor_torque == 0 && off <= rounding && off >= -rounding;
  }

  // Of the period that has been answered.
  void account(servo_summary& summary) noexcept {
    if (is_motor_clipped()) ++summary.motor_clipped;
    if (is_brake_clipped()) ++summary.brake_clipped;
    if (kept_share_ < 1) ++summary.shed, summary.least_share = std::min(summary.least_share, kept_share_);
    summary.lowest_position = has_moved_ ? std::min(summary.lowest_position, position_) : position_;
    summary.highest_position = has_moved_ ? std::max(summary.highest_position, position_) : position_;
    summary.largest_force = std::max(summary.largest_force, std::abs(wanted_.force));
    summary.largest_damping = std::max(summary.largest_damping, wanted_.damping);
    has_moved_ = true;
  }

  static void describe_sent(const actuation& sent, telemetry_record& record) noexcept {
    record.motor_torque = sent.motor_torque;
    record.brake_damping = sent.brake_damping;
  }
  void describe(telemetry_record& record) const noexcept {
    record.position = position_;
    record.velocity = velocity_;
    record.damping = wanted_.damping;
    record.motor_force = wanted_.force;
  }

 private:
  // Whether our limits or the device's own took something away.
  bool is_motor_clipped() const noexcept { return output_.motor_saturated() || motor_falls_short_; }
  bool is_brake_clipped() const noexcept {
    return is_less(output_.brake_damping, output_.brake_damping + output_.damping_clipped) || brake_falls_short_;
  }

  fault_report respond(const device_sample& sample) noexcept {
    if (!at_rest_) rest_at(sample);
    hold_coil_over_gap();
    if (const fault_report found = check_report(sample.report)) return found;
    heed(sample.report);
    const double joint_velocity = feed_.update(sample, monitor_.periods_since_last());
    if (const fault_report found = monitor_.check_velocity(joint_velocity)) return found;
    position_ = actuator_.gear().tool_motion(sample.position);
    velocity_ = actuator_.gear().tool_motion(joint_velocity);
    return drive(model_.output(static_cast<scalar>(position_), static_cast<scalar>(velocity_)));
  }

  fault_report drive(const command<scalar>& wanted) noexcept {
    wanted_ = {static_cast<double>(wanted.damping), static_cast<double>(wanted.force)};
    if (const fault_report found = monitor_.check_command(wanted_.damping, wanted_.force)) return found;
    sent_ = energy_.control(wanted_, position_, velocity_, hold_time());
    output_ = actuator_.drive(sent_, velocity_);
    const fault_report overflow = monitor_.check_command(output_.brake_damping, output_.motor_torque);
    if (overflow) return overflow;  // a finite force may be too large for a device without limits
    kept_share_ = kept_share_of(model_);
    const bool saturated = output_.motor_saturated() || motor_falls_short_ || kept_share_ < 1;
    if (const fault_report found = monitor_.check_saturation(saturated)) return found;
    demand_ = output_.demand();
    answered_ = true;
    return {};
  }

  // The torque also as the force at the tool, in which the energy is counted.
  fault_report check_report(const device_report& report) const noexcept {
    if (!report.told) return {};
    return monitor_.check_report(report.applied.brake_damping,
                                 actuator_.gear().tool_force(report.applied.motor_torque));
  }

  // Takes note of what the device made of a command: if it is less than was asked, that is reported and counted, and
  // the energy is computed with it.
  void heed(const device_report& report) noexcept {
    motor_falls_short_ = brake_falls_short_ = false;
    if (!report.told || report.commands_ago >= remembered || report.commands_ago >= commands_) return;
    const unsigned number = commands_ - report.commands_ago;
    const actuation& asked = sent_commands_[number % remembered];
    motor_falls_short_ = is_less(report.applied.motor_torque, asked.motor_torque);
    brake_falls_short_ = is_less(report.applied.brake_damping, asked.brake_damping);
    if (brake_falls_short_) forget_coil();
    energy_.tell(number, -actuator_.gear().tool_force(report.applied.motor_torque), !brake_falls_short_);
  }

  // By more than rounding on the way to the joint, and than a board loses that has the command in single precision.
  static bool is_less(double applied, double asked) noexcept {
    const double towards = asked < 0 ? -applied : applied, wanted = asked < 0 ? -asked : asked;
    return !(towards >= wanted * (1 - 1e-6) - 1e-30);
  }

  void rest_at(const device_sample& sample) noexcept {
    const double position = actuator_.gear().tool_motion(sample.position);
    model_.reset(static_cast<scalar>(position));
    stored_at_start_ = static_cast<double>(model_.stored_energy());
    energy_.reset(position);
    feed_.reset(sample);
    at_rest_ = true;
  }

  // The coil went on towards the last command while periods passed without a new one. What is certain of the brake over
  // the whole hold is the least of what is certain over its periods; over a very long one, nothing.
  void hold_coil_over_gap() noexcept {
    const unsigned periods = monitor_.periods_since_last();
    if (periods < 2) return;
    double assured = output_.assured_damping;
    for (unsigned period = 1; period < periods && period < remembered; ++period) {
      const double next = actuator_.drive(sent_, 0).assured_damping;
      if (next < assured) assured = next;
    }
    if (periods > remembered) assured = 0, forget_coil();
    energy_.hold(output_.applied_force, assured, held_);
  }

  // Periods may have passed without an account of the coil: from nothing on it is never credited with too much, for two
  // coils under the same demand keep their order.
  void forget_coil() noexcept { actuator_.reset(); }

  // Of the hold that ends with this period's sample [s].
  double hold_time() const noexcept { return monitor_.periods_since_last() * sample_period_; }

  Model& model_;
  velocity_feed<Estimator> feed_;
  safety_monitor monitor_;
  actuator<double> actuator_;
  energy_account energy_;
  static constexpr unsigned remembered = 256;  // commands, or periods of a gap; a power of two, for numbers wrap around

  double sample_period_;                 // [s]
  actuation sent_commands_[remembered];  // by number
  unsigned commands_ = 0;                // that have left, wrapping around
  unsigned held_ = 0;                    // the newest of the model's among them
  actuation safe_;
  actuation demand_;
  command<double> wanted_{};  // by the model
  command<double> sent_{};    // to the actuator
  actuator_output<double> output_;
  double position_ = 0;  // [m] or [rad]
  double velocity_ = 0;  // [m/s] or [rad/s]
  double kept_share_ = 1;
  double stored_at_start_ = 0;  // [J]
  bool at_rest_ = false;
  bool answered_ = false;
  bool has_left_ = false;           // the newest command
  bool motor_falls_short_ = false;  // of what it was asked for, by the newest report
  bool brake_falls_short_ = false;
  bool has_moved_ = false;  // the summary has seen a position
};

}  // namespace dashpot
