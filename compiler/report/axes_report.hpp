// What the compiler knows about a network of two axes as one HTML page without scripts.
#pragma once

#include <optional>
#include <string>

#include "emit/axes_emission.hpp"

namespace dashpot::compiler {

// In: everything about a network and its choices. Refuses: a template that does not fit.
std::optional<std::string> report(const AxesCompilation& compilation, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
