// What import, export and explain --as share.
#pragma once

#include "compile.hpp"

namespace dashpot::compiler {

// True for a spring with Maxwell elements in parallel; says of anything else what a Prony series cannot be.
bool is_prony_series(const Compilation& compilation, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
