// A described device led along a known motion, sample by sample: what its encoder shows, its estimator makes of that,
// and its motor and brake then do, so that one knows what the hand that leads it would feel. The motion goes straight
// from sample to sample; the motor is behind its amplifier, a first-order lag no faster than its slew, the brake behind
// its coil, and a command takes effect the device's delay after its sample. Mechanics and jitter take no part, and the
// brake's gain is nominal.
// No heap, no <cmath>.
#pragma once

#include <dashpot/actuator.hpp>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/exponential.hpp>
#include <dashpot/slewed_lag.hpp>

namespace dashpot {

// Samples at rest before a motion, so that estimator, delay line, amplifier and coil have come to rest themselves.
constexpr unsigned lead_in_samples(const device_description& device) noexcept {
  const double lag =
      device.motor.amplifier_lag > device.brake.coil_lag ? device.motor.amplifier_lag : device.brake.coil_lag;
  const double settled = 30 * lag / device.loop.sample_period;
  return settled < 200 ? 200 : settled < 1e6 ? static_cast<unsigned>(settled) + 1 : 1000000;
}

class led_device {
 public:
  // Requires can_drive(device, network).
  constexpr led_device(const device_description& device, motion network) noexcept
      : device_(device),
        estimator_(device.velocity, device.loop.sample_period, device.encoder.step),
        actuator_(device, network),
        coil_(device.brake),
        torque_kept_(decay_over(device.loop.sample_period)) {}

  // At rest at `position` of the tool [m] or [rad], motor and brake without current.
  void reset(double position) noexcept {
    last_position_ = actuator_.gear().joint_motion(position);
    estimator_.reset(quantised(last_position_));
    sensed_ = 0;
  }

  // One sample: the tool is at `position` and goes on with `velocity` [m/s] or [rad/s]. The law answers.
  template <class Model>
  void sample(Model& law, double position, double velocity) noexcept {
    using scalar = typename Model::scalar;
    const transmission<double>& gear = actuator_.gear();
    const double here = gear.joint_motion(position), speed = gear.joint_motion(velocity);
    go_on_to(here);
    const double before = felt(speed);
    const double estimate = estimator_.update(seen_at(here));
    const scalar shown = static_cast<scalar>(gear.tool_motion(quantised(here)));
    estimate_ = static_cast<double>(static_cast<scalar>(gear.tool_motion(estimate)));
    const command<scalar> wanted = law.step(shown, static_cast<scalar>(estimate_));
    command_ = {static_cast<double>(wanted.damping), static_cast<double>(wanted.force)};
    line_[index_ % length] = actuator_.drive(command_, estimate_).demand();
    take_effect();
    felt_ = gear.tool_force((before + felt(speed)) / 2);
    last_position_ = here;
    ++index_;
  }

  double estimate() const noexcept { return estimate_; }               // at the tool [m/s] or [rad/s]
  const command<double>& wanted() const noexcept { return command_; }  // by the law

  // By motor and brake at the newest sample, opposing +u: the mean of just before it and just after [N] or [N·m].
  double felt_force() const noexcept { return felt_; }

 private:
  static constexpr unsigned length = 65;  // samples of delay that a device file may state, and one

  // Advances device and sensor over the period before a sample.
  void go_on_to(double position) noexcept {
    if (index_ == 0) return;
    const double period = device_.loop.sample_period;
    const double wait = (device_.loop.write_earliest + device_.loop.write_latest) / 2;
    if (wait > 0) {
      act(before_, wait, decay_over(wait));
      act(demanded_, period - wait, decay_over(period - wait));
    } else {
      act(demanded_, period, torque_kept_);
    }
    before_ = demanded_;
    const double travelled = (position - last_position_) / period;
    const double rate = 6.283185307179586 * device_.velocity.bandwidth;
    sensed_ = rate > 0 ? travelled + (sensed_ - travelled) * decay(rate * period) : travelled;
    note_edge(position);
  }

  void take_effect() noexcept {
    const unsigned delay = device_.loop.delay_samples;
    demanded_ = index_ < delay ? actuation{} : line_[(index_ - delay) % length];
    if (!(device_.loop.write_latest > 0)) turn_to(demanded_);
  }

  // Motor and brake follow a demand at once if they have neither lag nor slew limit.
  void turn_to(const actuation& demand) noexcept {
    if (!(device_.motor.amplifier_lag > 0) && !(device_.motor.slew > 0)) torque_ = demand.motor_torque;
    if (!(device_.brake.coil_lag > 0) && !(coil_.slew() > 0)) coil_.reset(root_of(demand));
  }

  void act(const actuation& demand, double duration, double torque_kept) noexcept {
    const motor_description& motor = device_.motor;
    turn_to(demand);
    torque_ = motor.slew > 0 ? slewed_lag(torque_, demand.motor_torque, motor.amplifier_lag, motor.slew, duration)
                             : demand.motor_torque + (torque_ - demand.motor_torque) * torque_kept;
    coil_.advance(root_of(demand), duration);
  }

  // The share of a difference between torque and demand that is left after a duration.
  constexpr double decay_over(double duration) const noexcept {
    return device_.motor.amplifier_lag > 0 ? decay(duration / device_.motor.amplifier_lag) : 0.0;
  }

  double root_of(const actuation& demand) const noexcept {
    const double most = device_.brake.kind == brake_kind::none ? 0 : device_.brake.max_damping;
    return square_root(demand.brake_damping < most ? demand.brake_damping : most);
  }

  // At the joint, opposing +q.
  double felt(double speed) const noexcept {
    const bool has_brake = device_.brake.kind != brake_kind::none;
    const double share = device_.brake.critical_speed > 0 ? speed / device_.brake.critical_speed : 0;
    const double damping = has_brake ? (coil_.damping() + device_.brake.residual_damping) / (1 + share * share) : 0;
    return damping * speed - torque_;
  }

  double whole_steps(double position) const noexcept {
    return floor_of(position / device_.encoder.step + (device_.encoder.rounding == quantiser::round ? 0.5 : 0.0));
  }
  double quantised(double position) const noexcept {
    return device_.encoder.step > 0 ? whole_steps(position) * device_.encoder.step : position;
  }
  static double floor_of(double value) noexcept {
    const double cut = static_cast<double>(static_cast<std::int64_t>(value));
    return cut > value ? cut - 1 : cut;
  }

  // Notes the time of the last encoder edge on the straight way from the previous sample.
  void note_edge(double position) noexcept {
    if (!(device_.encoder.step > 0)) return;
    const double from = whole_steps(last_position_), to = whole_steps(position);
    if (from == to) return;
    const double boundary = (to > from ? to : to + 1) - (device_.encoder.rounding == quantiser::round ? 0.5 : 0.0);
    const double share = (boundary * device_.encoder.step - last_position_) / (position - last_position_);
    edge_time_ = (static_cast<double>(index_) - 1 + share) * device_.loop.sample_period;
  }

  device_sample seen_at(double position) const noexcept {
    device_sample seen;
    seen.position = quantised(position);
    seen.velocity = sensed_;
    seen.counts = device_.encoder.step > 0 ? static_cast<std::int64_t>(whole_steps(position)) : 0;
    seen.timestamp_ns = nanoseconds(static_cast<double>(index_) * device_.loop.sample_period);
    seen.edge_time_ns = nanoseconds(edge_time_);
    seen.sequence = static_cast<std::uint32_t>(index_);
    return seen;
  }
  static std::uint64_t nanoseconds(double seconds) noexcept {
    return seconds > 0 ? static_cast<std::uint64_t>(seconds * 1e9 + 0.5) : 0;
  }

  device_description device_;
  any_estimator<double> estimator_;
  actuator<double> actuator_;
  brake_coil<double> coil_;
  double torque_kept_;  // of a difference, over a period
  actuation line_[length] = {};
  actuation demanded_, before_;  // of the newest sample and of the one before
  command<double> command_{0, 0};
  double torque_ = 0;         // [N·m] or [N]
  double last_position_ = 0;  // [rad] or [m]
  double sensed_ = 0;         // [rad/s] or [m/s]
  double edge_time_ = 0;      // [s]
  double estimate_ = 0, felt_ = 0;
  unsigned long index_ = 0;
};

}  // namespace dashpot
