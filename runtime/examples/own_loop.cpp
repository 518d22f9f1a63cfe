// A servo loop around a device of one's own: a mass of 1 kg on a soft spring, so that the program runs anywhere. Yours
// talks to its encoder in read(), and to its motor and brake in write(). The law is compiled for no device, so the loop
// warns that it is not certified here. The energy that it tells ends below zero: an encoder of 10 um leaves little of
// the brake's heat certain, and only that is counted; with steps of 1 um it ends above zero.
#include <cmath>
#include <cstdio>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>

#include "second_order_maxwell.hpp"

struct my_device {
  my_device() {
    facts.encoder = {1e-5, dashpot::quantiser::floor, -0.1, 0.1, 2.0};  // step, rounding, range [m], top speed [m/s]
    facts.velocity.window = 15;                                         // samples
    facts.motor.max_torque = 5.0;                                       // [N], for it moves in translation
    facts.brake = {dashpot::brake_kind::eddy_current, 20.0};            // at most [N·s/m]
    facts.brake.safe_damping = 5.0;                                     // after every fault [N·s/m]
  }
  dashpot::device_status read(dashpot::device_sample& sample) noexcept {
    sample.position = facts.encoder.step * std::floor(position / facts.encoder.step);
    sample.sequence = ++samples;
    sample.report = {true, 0, last};  // the newest command is in force: the loop can say that it left the device safe
    return dashpot::device_status::ok;
  }
  dashpot::device_status write(const dashpot::actuation& wanted) noexcept {
    const double force = wanted.motor_torque - wanted.brake_damping * velocity + 30.0 * (0.02 - position);  // [N]
    velocity += force * facts.loop.sample_period;
    position += velocity * facts.loop.sample_period;
    last = wanted;
    return dashpot::device_status::ok;
  }
  const dashpot::device_description& description() const noexcept { return facts; }

  dashpot::device_description facts;  // at 1 kHz, where nothing else is said
  std::uint32_t samples = 0;
  dashpot::actuation last;
  double position = 0, velocity = 0;  // [m], [m/s]
};

int main() {
  dashpot::generated::second_order_maxwell tissue;
  my_device device;
  const double period = device.facts.loop.sample_period;
  dashpot::any_estimator<double> estimator(device.facts.velocity, period, device.facts.encoder.step);
  dashpot::servo_options options;
  options.identity.name = "my_device";
  options.duration = 1.0;  // [s]
  dashpot::servo_loop loop(tissue, device, estimator, options);
  const dashpot::stop_on_signals ctrl_c(loop.control());
  const dashpot::servo_summary summary = loop.run();
  std::fputs(dashpot::to_text(summary).c_str(), stdout);
  return summary.left_safe ? 0 : 1;
}
