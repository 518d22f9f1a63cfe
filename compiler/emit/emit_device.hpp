// From a device file to what a servo loop has to know of the device, so that nobody copies a number.
#pragma once

#include <optional>
#include <string>

#include "emit/device_facts.hpp"
#include "network/axes_device.hpp"
#include "network/device.hpp"
#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// A header with name, digest and description. Refuses: templates that do not fit.
std::optional<std::string> emit_device(const Device& device, DeviceLanguage language, Diagnostics& diagnostics);

// The same of a device of two axes, in C++.
std::optional<std::string> emit_arm_device(const AxesDevice& device, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
