// A device that arms the trap between the end of a read and the beginning of the write that answers it.
#pragma once

#include <dashpot/device.hpp>

#include "trap.hpp"

namespace dashpot::tests {

template <class Device>
class guarded_device {
 public:
  explicit guarded_device(Device& device) : device_(device) {}

  device_status read(device_sample& sample) noexcept {
    const device_status status = device_.read(sample);
    arm_trap();
    return status;
  }
  device_status write(const actuation& wanted) noexcept {
    disarm_trap();
    return device_.write(wanted);
  }
  const device_description& description() const noexcept { return device_.description(); }

 private:
  Device& device_;
};

}  // namespace dashpot::tests
