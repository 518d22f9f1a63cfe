// The two actuators of a simulated device as functions of time: the motor behind its amplifier, a first-order lag no
// faster than its slew, and the brake behind its coil,
//     b = (gain·κ i² + residual)/(1 + (q̇/v_c)²),     gain = 1 ± tolerance.
// Both are solved exactly; nothing here depends on the integration step. In the joint's coordinate.
#pragma once

#include <dashpot/brake_coil.hpp>
#include <dashpot/device.hpp>
#include <dashpot/device_description.hpp>
#include <dashpot/simulated/scenario.hpp>

namespace dashpot::simulated {

class drives {
 public:
  drives(const device_description& device, const scenario& scene);

  // From now on, within max_torque and max_damping. `demand` must be finite.
  void demand(const actuation& demand) noexcept;
  void advance(double duration) noexcept;  // [s]

  // A disturbance that the amplifier adds after lag and limit, until the next call [N·m] or [N].
  void disturb(double torque) noexcept { disturbance_ = torque; }

  double torque() const noexcept { return disturbed(torque_); }  // of the motor, along +q [N·m] or [N]
  double torque_after(double duration) const noexcept { return disturbed(amplified_after(duration)); }
  double damping() const noexcept { return damping_of(coil_.root_damping()); }  // of the brake, at no speed
  double damping_after(double duration) const noexcept { return damping_of(coil_.after(demanded_root_, duration)); }

  // The damping at `velocity` that is `damping` at rest, by the brake's fading [N·m·s/rad] or [N·s/m].
  double at_speed(double damping, double velocity) const noexcept {
    const double share = velocity * per_critical_speed_;
    return damping / (1 + share * share);
  }
  bool fades_with_speed() const noexcept { return per_critical_speed_ > 0; }

 private:
  double damping_of(double root) const noexcept { return gain_ * root * root + residual_; }
  double amplified_after(double duration) const noexcept;
  double disturbed(double torque) const noexcept { return disturbance_ != 0 ? torque + disturbance_ : torque; }

  double amplifier_lag_;       // [s]
  double motor_slew_;          // [N·m/s] or [N/s]; 0: unlimited
  double max_torque_;          // [N·m] or [N]; 0: unlimited
  double max_damping_;         // [N·m·s/rad] or [N·s/m]
  double residual_;            // damping at zero current
  double gain_;                // true damping over demanded
  double per_critical_speed_;  // 1/v_c; 0: does not fade
  brake_coil<double> coil_;
  double torque_ = 0;           // without the disturbance [N·m] or [N]
  double disturbance_ = 0;      // [N·m] or [N]
  double demanded_torque_ = 0;  // [N·m] or [N]
  double demanded_root_ = 0;    // √ of the demanded damping
};

}  // namespace dashpot::simulated
