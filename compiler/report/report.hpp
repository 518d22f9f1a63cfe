// The picture for people: one HTML file that needs nothing else.
#pragma once

#include <optional>
#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// In: everything about one network; the emitted code as a module of WebAssembly, or nothing. Out: the page. What only
// makes sense for a linear network is left out where there are slips.
std::optional<std::string> report(const Compilation& compilation, const std::optional<std::string>& module,
                                  Diagnostics& diagnostics);

}  // namespace dashpot::compiler
