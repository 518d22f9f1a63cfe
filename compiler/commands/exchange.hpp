// What import, export and explain --as share.
#pragma once

#include "compile.hpp"

namespace dashpot::compiler {

// True for a spring with Maxwell elements in parallel; reports for anything else why it is no Prony series.
bool is_prony_series(const Compilation& compilation, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
