// A device file in SI units, checked.
#pragma once

#include <dashpot/device_description.hpp>

#include <optional>
#include <string>
#include <vector>

#include "source/diagnostic.hpp"
#include "syntax/device_decl.hpp"

namespace dashpot::compiler {

struct Device {
  std::string name;
  std::string source;
  std::vector<std::string> assumed;  // dotted keys whose values are not published
  device_description description;    // SI, in the joint's coordinate
  std::string digest;                // of the file's bytes
};

// In: what the author wrote. Out: the device in SI. Refuses: wrong units, negative values, unknown estimators, ranges
// the wrong way round, a safe damping above the brake's greatest, and so on, all at once.
std::optional<Device> build_device(const DeviceDecl& decl, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
