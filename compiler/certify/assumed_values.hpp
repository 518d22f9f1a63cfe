// Variants of a device in which one of the values that its file marks as assumed is a fifth larger or smaller.
#pragma once

#include <string>
#include <vector>

#include "network/device.hpp"

namespace dashpot::compiler {

inline constexpr double assumed_spread = 0.2;  // share by which each value is raised and lowered [1]

struct VariedDevice {
  std::string key;  // key of the value that differs, as the device file has it
  Device device;
};

// Two variants for each assumed value that affects what is felt or what is certified, one value at a time. Integer
// values, and values that affect neither, are not varied.
std::vector<VariedDevice> with_assumed_varied(const Device& device);

}  // namespace dashpot::compiler
