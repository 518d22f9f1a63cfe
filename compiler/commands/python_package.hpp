// A network's law as a package for Python.
#pragma once

#include <optional>
#include <vector>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// NAME/: __init__.py, explain.json, law.c around NAME.h, and law.so, which $CC or cc makes of them for this machine.
// Refuses: what emit_c99() refuses, a name that Python needs for itself, a compiler that is missing or fails, a folder
// that cannot be made.
std::optional<std::vector<OutputFile>> emit_python(const Compilation& compilation, const EmissionOptions& options,
                                                   Diagnostics& diagnostics);

}  // namespace dashpot::compiler
