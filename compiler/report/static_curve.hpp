// The static curve of a network on its page.
#pragma once

#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// The wanted force over displacement and what the emitted map makes of it, and what the other figures are of; empty
// without a static curve. `of`: of which port, behind the figure's title.
std::string static_curve_html(const Compilation& compilation, const std::string& of = "");

}  // namespace dashpot::compiler
