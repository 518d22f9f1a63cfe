#include <dashpot/simulated/drives.hpp>

#include <algorithm>
#include <cmath>

#include <dashpot/simulated/draw.hpp>

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

namespace {

// The equation of a coil's √b is that of a torque too.
brake_coil<double> amplifier(const motor_description& motor) {
  brake_description as_coil;
  as_coil.coil_lag = motor.amplifier_lag;
  as_coil.slew = motor.slew;
  as_coil.damping_per_current_squared = 1;
  return brake_coil<double>(as_coil);
}

}  // namespace

drives::drives(const device_description& device, const scenario& scene)
    : max_torque_(device.motor.max_torque),
      max_damping_(device.brake.kind == brake_kind::none ? 0 : device.brake.max_damping),
      residual_(device.brake.kind == brake_kind::none ? 0 : device.brake.residual_damping),
      gain_(gain_of(device.brake, scene)),
      per_critical_speed_(device.brake.critical_speed > 0 ? 1 / device.brake.critical_speed : 0),
      coil_(device.brake),
      torque_(amplifier(device.motor)),
      is_instant_(device.motor.amplifier_lag == 0 && device.motor.slew == 0) {}

void drives::demand(const actuation& demand) noexcept {
  const double most = max_torque_ > 0 ? max_torque_ : HUGE_VAL;
  demanded_torque_ = std::clamp(demand.motor_torque, -most, most);
  demanded_root_ = std::sqrt(std::clamp(demand.brake_damping, 0.0, max_damping_));
  if (is_instant_) torque_.reset(demanded_torque_);
}

void drives::advance(double duration) noexcept {
  torque_.advance(demanded_torque_, duration);
  coil_.advance(demanded_root_, duration);
}

double drives::torque_after(double duration) const noexcept { return torque_.after(demanded_torque_, duration); }

}  // namespace dashpot::simulated
