// What `dashpot explain` says of a compilation whose candidates are weighed.
#pragma once

#include <string>

#include "compile.hpp"

namespace dashpot::compiler {

// No line is wider than 100 columns, but where a single word is.
std::string explain_text(const Compilation& compilation, bool with_legend);
std::string explain_json(const Compilation& compilation);

// The fastest relaxation rate of what joins tool and ground without slips, and of what is behind slips in each regime
// [1/s].
double fastest_rate(const Compilation& compilation);

}  // namespace dashpot::compiler
