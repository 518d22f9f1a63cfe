// What `dashpot explain` says of a compilation whose candidates are weighed.
#pragma once

#include <string>

#include "compile.hpp"

namespace dashpot::compiler {

std::string explain_text(const Compilation& compilation);
std::string explain_json(const Compilation& compilation);

// Of what joins tool and ground without slips, and of what is behind slips in each of their regimes [1/s].
double fastest_rate(const Compilation& compilation);

}  // namespace dashpot::compiler
