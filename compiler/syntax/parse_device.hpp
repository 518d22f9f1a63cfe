// From the text of a device file to what its author wrote (architecture, section 3; runtime/devices/README.md).
#pragma once

#include <optional>

#include "source/diagnostic.hpp"
#include "syntax/device_decl.hpp"
#include "syntax/json.hpp"

namespace dashpot::compiler {

// In: a device file of format 1. Out: its declaration. Ensures: sections known, unless `complete` is false. Refuses:
// what is not JSON, not a device file, or another format; everything else is reported and survives as an incomplete
// declaration, so that build_device can find further problems.
std::optional<DeviceDecl> parse_device(const SourceFile& file, Diagnostics& diagnostics);

// Of an object with keys of a device file: of a joint or a brake of a device of two axes.
DeviceDecl parse_device_object(const JsonValue& object, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
