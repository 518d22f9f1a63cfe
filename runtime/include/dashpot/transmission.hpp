// Between the joint's coordinate, in which a device is described, and the tool's, in which a network acts (theory.md,
// section 7): u = r q, torque = r F, B_joint = r² B, K_joint = r² K. The ratio r is the arm radius [m/rad] where a
// translational network meets a rotary joint, and 1 otherwise.
#pragma once

#include <dashpot/device_description.hpp>

namespace dashpot {

// False where network and joint move differently and no arm radius relates them: such a pair must not run.
constexpr bool can_drive(const device_description& device, motion network) noexcept {
  if (device.motion == network) return true;
  return device.motion == motion::rotation && device.arm_radius > 0;
}

template <class Scalar>
class transmission {
 public:
  // Requires can_drive(device, network).
  constexpr transmission(const device_description& device, motion network) noexcept
      : ratio_(device.motion == network ? Scalar(1) : static_cast<Scalar>(device.arm_radius)) {}

  constexpr Scalar ratio() const noexcept { return ratio_; }                                     // [m/rad] or 1
  constexpr Scalar tool_motion(Scalar joint) const noexcept { return ratio_ * joint; }           // position or velocity
  constexpr Scalar joint_motion(Scalar tool) const noexcept { return tool / ratio_; }            //
  constexpr Scalar joint_torque(Scalar force) const noexcept { return ratio_ * force; }          // [N] → [N·m]
  constexpr Scalar tool_force(Scalar torque) const noexcept { return torque / ratio_; }          // [N·m] → [N]
  constexpr Scalar joint_damping(Scalar tool) const noexcept { return ratio_ * ratio_ * tool; }  // damping, stiffness
  constexpr Scalar tool_damping(Scalar joint) const noexcept { return joint / (ratio_ * ratio_); }  // or inertia

 private:
  Scalar ratio_;
};

}  // namespace dashpot
