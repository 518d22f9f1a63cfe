// The key that says what a file is: "dashpot" in network files, "dashpot_device" in device files.
#pragma once

#include "syntax/object_reader.hpp"

namespace dashpot::compiler {

enum class FileKind { network, device };

// Reports what is not a file of that kind in format 1. A missing key is reported too, and taken for format 1.
bool is_format_1(FileKind kind, const JsonValue& root, Diagnostics& diagnostics);

// False, reported, where the file says that it is of more than one axis.
bool is_of_one_axis(FileKind kind, const JsonValue& root, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
