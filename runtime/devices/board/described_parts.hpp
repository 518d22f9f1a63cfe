// The parts of a device's description, whether it is of one axis or of two.
#pragma once

#include <dashpot/arm_description.hpp>

namespace dashpot::board {

constexpr const device_description& described_joint(const device_description& device, unsigned) noexcept {
  return device;
}
constexpr const device_description& described_joint(const arm_description& arm, unsigned joint) noexcept {
  return arm.joints[joint];
}

// A brake that the device does not have makes no damping.
constexpr brake_description described_brake(const device_description& device, unsigned) noexcept {
  return device.brake;
}
constexpr brake_description described_brake(const arm_description& arm, unsigned brake) noexcept {
  return dashpot::brake_of(arm, brake).brake;
}

template <class Description>
constexpr const loop_description& described_loop(const Description& described) noexcept {
  return described_joint(described, 0).loop;
}

}  // namespace dashpot::board
