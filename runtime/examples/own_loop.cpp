// A servo loop of one's own: an emitted model, one's own device class, and the loop between them. This device is a mass
// of 1 kg on a soft spring, so that the program runs anywhere; an encoder, a motor and a brake take its place.
#include <cmath>
#include <cstdio>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>

#include "second_order_maxwell.hpp"

class my_device {
 public:
  dashpot::device_status read(dashpot::device_sample& sample) noexcept {
    sample.position = description_.encoder.step * std::floor(position_ / description_.encoder.step);
    sample.sequence = ++sequence_;
    return dashpot::device_status::ok;
  }

  dashpot::device_status write(const dashpot::actuation& wanted) noexcept {
    velocity_ += (wanted.motor_torque - wanted.brake_damping * velocity_ + 30.0 * (0.02 - position_)) * 0.001;
    position_ += velocity_ * 0.001;
    return dashpot::device_status::ok;
  }

  const dashpot::device_description& description() const noexcept { return description_; }

 private:
  dashpot::device_description description_ = [] {
    dashpot::device_description device;
    device.loop.sample_period = dashpot::generated::second_order_maxwell::sample_period;
    device.encoder = {1e-5, dashpot::quantiser::floor, -0.1, 0.1, 2.0};  // step, rounding, range [m], top speed [m/s]
    device.velocity.window = 15;
    device.motor.max_torque = 5.0;  // [N]: this device moves in translation
    device.brake = {dashpot::brake_kind::eddy_current, 20.0};  // at most [N·s/m]
    device.brake.safe_damping = 5.0;
    return device;
  }();
  std::uint32_t sequence_ = 0;
  double position_ = 0;  // [m]
  double velocity_ = 0;  // [m/s]
};

int main() {
  dashpot::generated::second_order_maxwell tissue;
  my_device device;
  const dashpot::device_description& facts = device.description();
  dashpot::any_estimator<double> estimator(facts.velocity, facts.loop.sample_period, facts.encoder.step);
  dashpot::servo_options options;
  options.identity.name = "my_device";
  options.duration = 1.0;  // [s]
  dashpot::servo_loop loop(tissue, device, estimator, options);
  const dashpot::stop_on_signals ctrl_c(loop.control());
  const dashpot::servo_summary summary = loop.run();
  std::fputs(dashpot::to_text(summary).c_str(), stdout);
  return summary.left_safe ? 0 : 1;
}
