#include <dashpot/simulated/drives.hpp>

#include <algorithm>
#include <cmath>

#include <dashpot/simulated/draw.hpp>
#include <dashpot/slewed_lag.hpp>

namespace dashpot::simulated {
namespace {

double gain_of(const brake_description& brake, const scenario& scene) {
  switch (scene.gain) {
    case brake_gain::nominal: return 1;
    case brake_gain::lowest: return 1 - brake.tolerance;
    case brake_gain::highest: return 1 + brake.tolerance;
    case brake_gain::drawn: break;
  }
  return 1 + brake.tolerance * (2 * draw_uniform(scene.seed, draw_stream::brake_gain, 0) - 1);
}

}  // namespace

drives::drives(const device_description& device, const scenario& scene)
    : amplifier_lag_(device.motor.amplifier_lag),
      motor_slew_(device.motor.slew),
      max_torque_(device.motor.max_torque),
      max_damping_(device.brake.kind == brake_kind::none ? 0 : device.brake.max_damping),
      residual_(device.brake.kind == brake_kind::none ? 0 : device.brake.residual_damping),
      gain_(gain_of(device.brake, scene)),
      per_critical_speed_(device.brake.critical_speed > 0 ? 1 / device.brake.critical_speed : 0),
      coil_(device.brake) {}

void drives::demand(const actuation& demand) noexcept {
  const double most = max_torque_ > 0 ? max_torque_ : HUGE_VAL;
  demanded_torque_ = std::clamp(demand.motor_torque, -most, most);
  demanded_root_ = std::sqrt(std::clamp(demand.brake_damping, 0.0, max_damping_));
  if (!(amplifier_lag_ > 0) && !(motor_slew_ > 0)) torque_ = demanded_torque_;
}

void drives::advance(double duration) noexcept {
  torque_ = amplified_after(duration);
  coil_.advance(demanded_root_, duration);
}

double drives::amplified_after(double duration) const noexcept {
  if (torque_ == demanded_torque_) return torque_;
  if (motor_slew_ > 0) return slewed_lag(torque_, demanded_torque_, amplifier_lag_, motor_slew_, duration);
  return demanded_torque_ + (torque_ - demanded_torque_) * std::exp(-duration / amplifier_lag_);
}

}  // namespace dashpot::simulated
