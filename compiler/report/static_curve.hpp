// The static curve of a network on its page.
#pragma once

#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// The wanted force over displacement and what the emitted map makes of it, and what the other figures are of; empty
// without a static curve.
std::string static_curve_html(const Compilation& compilation);

}  // namespace dashpot::compiler
