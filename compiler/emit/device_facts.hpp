// A device's description as statements that fill in a `facts`, for every language that knows its fields by these names.
#pragma once

#include <dashpot/device_description.hpp>

#include <string>
#include <vector>

namespace dashpot::compiler {

enum class DeviceLanguage { cpp, c99 };

struct DeviceFact {
  std::string field;  // as "loop.jitter"
  std::string value;  // a literal of the language, or an enumerator
  std::string remark;
};

// Every field of the description.
std::vector<DeviceFact> all_facts(const device_description& device, DeviceLanguage language);

// Those that matter for a device that is led along a known motion.
std::vector<DeviceFact> facts_of_led_device(const device_description& device);

}  // namespace dashpot::compiler
