// A device whose file marks values as assumed, with one of them a fifth more or less.
#pragma once

#include <string>
#include <vector>

#include "network/device.hpp"

namespace dashpot::compiler {

inline constexpr double assumed_spread = 0.2;  // of each value, up and down [1]

struct VariedDevice {
  std::string key;  // of the value that differs, as the device file has it
  Device device;
};

// Two for each assumed value that what is felt or what is certified depends on, one value at a time. Whole numbers, and
// what neither depends on, are left alone.
std::vector<VariedDevice> with_assumed_varied(const Device& device);

}  // namespace dashpot::compiler
