// Watches one loop on one device for the faults of fault.hpp. No heap, no clock, no input or output: the
// loop shows it what happened in a period, in running order, and sends the safe command when a check returns a fault.
//
// A sample is fresh when the device calls it ok and its sequence number has moved on. Up to
// loop.missed_deadlines_allowed periods in a row may pass without one: the loop then holds its last command.
#pragma once

#include <cstdint>

#include <dashpot/command.hpp>
#include <dashpot/device.hpp>
#include <dashpot/servo/fault.hpp>

namespace dashpot {

class safety_monitor {
 public:
  explicit constexpr safety_monitor(const device_description& device) noexcept : device_(device) {}

  // Forgets everything before: the next fresh sample has no predecessor to jump from.
  constexpr void restart() noexcept {
    missed_in_row_ = 0;
    periods_blind_ = 0;
    periods_since_last_ = 0;
    periods_saturated_ = 0;
    commands_lost_ = 0;
    has_last_ = false;
  }

  // The loop woke up for this period after skipping `missed` whole ones, in which the machine itself slept for `asleep`
  // [s]: any sleep is a fault, however short.
  constexpr fault_report check_wake_up(unsigned missed, double asleep = 0) noexcept {
    if (asleep > 0) return {fault::suspended, asleep, 0};
    missed_in_row_ = missed != 0 ? capped(missed_in_row_, missed) : 0;
    periods_blind_ = capped(periods_blind_, missed);
    if (missed_in_row_ > allowed()) return {fault::missed_deadlines, double(missed_in_row_), double(allowed())};
    return {};
  }

  // What the device answered, in sequence after check_wake_up. Sets is_fresh() and periods_since_last().
  constexpr fault_report check_sample(device_status status, const device_sample& sample) noexcept {
    fresh_ = false;
    if (is_broken(status)) return device_error(status);
    if (!is_new(status, sample)) return one_more_blind_period();
    const fault_report report = check_position(sample);
    if (!report) accept(sample);
    return report;
  }

  // False: no new sample this period, hold the last command.
  constexpr bool is_fresh() const noexcept { return fresh_; }

  // Periods between the newest fresh sample and the one before; 1 for the first. At most 2·allowed + 1.
  constexpr unsigned periods_since_last() const noexcept { return periods_since_last_; }

  // The estimate at the joint, [rad/s] or [m/s].
  constexpr fault_report check_velocity(double velocity) const noexcept {
    const double limit = device_.encoder.max_speed;
    if (!is_finite(velocity)) return {fault::velocity_not_finite, velocity, limit};
    if (limit > 0 && magnitude(velocity) > limit) return {fault::overspeed, velocity, limit};
    return {};
  }

  // The model's command, in its own unit.
  constexpr fault_report check_command(double damping, double force) const noexcept {
    return check_finite(fault::command_not_finite, damping, force);
  }

  // What the device says that a motor and a brake apply, in the joint's unit. Energy that is reckoned with it would be
  // no number from there on.
  constexpr fault_report check_report(double damping, double torque) const noexcept {
    return check_finite(fault::report_not_finite, damping, torque);
  }

  // Whether the motor could not make all of this period's torque.
  constexpr fault_report check_saturation(bool saturated) noexcept {
    periods_saturated_ = saturated ? periods_saturated_ + periods_since_last_ : 0;
    const double allowed_time = device_.motor.saturation_allowed;
    const double time = static_cast<double>(periods_saturated_) * device_.loop.sample_period;
    // Half a period: both times are whole periods, and the comparison must not depend on the last bit.
    const double margin = device_.loop.sample_period / 2;
    if (allowed_time > 0 && time > allowed_time + margin) return {fault::motor_saturated, time, allowed_time};
    return {};
  }

  // What the device answered to the command. One that could not be sent leaves the command before in force, like a
  // missed deadline, and as many in a row are allowed.
  constexpr fault_report check_write(device_status status) noexcept {
    commands_lost_ = status == device_status::ok ? 0 : commands_lost_ + 1;
    if (is_broken(status) || commands_lost_ > allowed()) return device_error(status);
    return {};
  }

  static constexpr fault_report device_error(device_status status) noexcept {
    return {fault::device_error, static_cast<double>(status), 0, nullptr};
  }

 private:
  static constexpr bool is_broken(device_status status) noexcept {
    return status == device_status::fault || status == device_status::disconnected;
  }
  constexpr unsigned allowed() const noexcept {
    const unsigned stated = device_.loop.missed_deadlines_allowed;
    return stated < most_missed_deadlines ? stated : most_missed_deadlines;
  }

  // A count that is beyond what any device allows only has to stay there, without overflow.
  static constexpr unsigned capped(unsigned count, unsigned more) noexcept {
    constexpr unsigned enough = 4 * most_missed_deadlines;
    return more < enough - count ? count + more : enough;
  }

  // Signed, so that the number may wrap around and an overtaken sample is not new.
  constexpr bool is_new(device_status status, const device_sample& sample) const noexcept {
    return status == device_status::ok && (!has_last_ || sequence_step(sample) > 0);
  }
  constexpr std::int32_t sequence_step(const device_sample& sample) const noexcept {
    return static_cast<std::int32_t>(sample.sequence - last_sequence_);
  }

  constexpr fault_report one_more_blind_period() noexcept {
    periods_blind_ = capped(periods_blind_, 1);
    if (periods_blind_ > allowed()) return {fault::no_data, double(periods_blind_), double(allowed())};
    return {};
  }

  constexpr fault_report check_position(const device_sample& sample) const noexcept {
    const encoder_description& encoder = device_.encoder;
    const double position = sample.position;
    if (!is_finite(position)) return {fault::position_not_finite, position, 0};
    if (encoder.range_low < encoder.range_high) {
      if (position < encoder.range_low) return {fault::position_out_of_range, position, encoder.range_low};
      if (position > encoder.range_high) return {fault::position_out_of_range, position, encoder.range_high};
    }
    return check_jump(sample);
  }

  // Two samples may lie a period plus the stated jitter apart, and their roundings one step.
  constexpr fault_report check_jump(const device_sample& sample) const noexcept {
    if (!has_last_ || device_.encoder.max_speed <= 0) return {};
    const double time = periods_before(sample) * device_.loop.sample_period + device_.loop.jitter;
    const double limit = device_.encoder.max_speed * time + device_.encoder.step;
    const double moved = sample.position - last_position_;
    if (magnitude(moved) > limit) return {fault::encoder_jump, moved, limit};
    return {};
  }

  // The host counts the periods it slept through, the device's sequence number those whose samples were lost. A wild
  // number must not widen the limits without end.
  constexpr unsigned periods_before(const device_sample& sample) const noexcept {
    if (!has_last_) return 1;
    const auto lost = static_cast<unsigned>(sequence_step(sample)) - 1;
    const unsigned believed = lost < allowed() ? lost : allowed();
    return (periods_blind_ > believed ? periods_blind_ : believed) + 1;
  }

  constexpr void accept(const device_sample& sample) noexcept {
    periods_since_last_ = periods_before(sample);
    periods_blind_ = 0;
    last_position_ = sample.position;
    last_sequence_ = sample.sequence;
    has_last_ = true;
    fresh_ = true;
  }

  static constexpr fault_report check_finite(fault kind, double damping, double force) noexcept {
    if (!all_finite(damping, force, 0.0)) return {kind, is_finite(force) ? damping : force, 0};
    return {};
  }
  static constexpr bool is_finite(double value) noexcept { return all_finite(value, 0.0, 0.0); }
  static constexpr double magnitude(double value) noexcept { return value < 0 ? -value : value; }

  device_description device_;
  unsigned missed_in_row_ = 0;
  unsigned periods_blind_ = 0;       // whole periods before this one without a fresh sample
  unsigned periods_since_last_ = 0;  // between the two newest fresh samples
  unsigned periods_saturated_ = 0;
  unsigned commands_lost_ = 0;
  double last_position_ = 0;  // [rad] or [m]
  std::uint32_t last_sequence_ = 0;
  bool has_last_ = false;
  bool fresh_ = false;
};

}  // namespace dashpot
