// What the compiler knows about a network of two axes as one HTML page that asks for nothing beyond itself.
#pragma once

#include <optional>
#include <string>

#include "emit/axes_emission.hpp"

namespace dashpot::compiler {

// In: everything about a network and its choices, and the emitted code as a module of WebAssembly, with which the page
// lets its reader drag the tool; without a module it has no scripts. Refuses: a template that does not fit.
std::optional<std::string> report(const AxesCompilation& compilation, const std::optional<std::string>& module,
                                  Diagnostics& diagnostics);

}  // namespace dashpot::compiler
