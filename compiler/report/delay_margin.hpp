// How much damping is left over frequency when the estimate of velocity comes as late as it likes (theory, section 4).
#pragma once

#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// Of a linear network: the chosen candidate beside the one without a brake.
std::string delay_margin_html(const Compilation& compilation);

}  // namespace dashpot::compiler
