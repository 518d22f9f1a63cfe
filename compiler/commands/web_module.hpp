// A network's emitted code as a module of WebAssembly.
#pragma once

#include <optional>
#include <string>

#include "emit/axes_emission.hpp"

namespace dashpot::compiler {

// Compiles with $DASHPOT_CLANG, else with the clang++ that there is. Warns, and returns nothing, where none makes
// WebAssembly, or there is no folder to make it in. Refuses, with an error: templates that do not fit.
std::optional<std::string> web_module(const Compilation& compilation, Diagnostics& diagnostics);
std::optional<std::string> web_module(const AxesCompilation& compilation, Diagnostics& diagnostics);

// The same module, where it is what was asked for: an error, where none can be made.
std::optional<std::string> web_module_for_target(const Compilation& compilation, const EmissionOptions& options,
                                                 Diagnostics& diagnostics);

}  // namespace dashpot::compiler
