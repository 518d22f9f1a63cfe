// From the text of a device file to what its author wrote (architecture, section 3; runtime/devices/README.md).
#pragma once

#include <optional>

#include "source/diagnostic.hpp"
#include "syntax/device_decl.hpp"

namespace dashpot::compiler {

// In: a device file of format 1. Out: its declaration. Ensures: sections known, unless `complete` is false. Refuses:
// what is not JSON, not a device file, or another format; everything else is reported and survives as an incomplete
// declaration, so that build_device can find further problems.
std::optional<DeviceDecl> parse_device(const SourceFile& file, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
