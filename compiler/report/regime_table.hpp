// What the brake takes over in each regime of a network with slips.
#pragma once

#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// A paragraph and a table for each component with slips; empty text for a network without.
std::string regimes_html(const Compilation& compilation);

}  // namespace dashpot::compiler
