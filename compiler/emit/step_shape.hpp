// Whether a law can be emitted in a form that is asked for.
#pragma once

#include "emit/emission.hpp"

namespace dashpot::compiler {

// Whether a step may be asked to take constant time: not of coupled slips, whose solvers' time depends on the values.
bool can_be_timed(const Compilation& compilation);
// The same, and reports what it says no to.
bool can_be_timed(const Compilation& compilation, Diagnostics& diagnostics);

// Refuses, in C99, names that C or <dashpot/command.h> keeps: the network's name is also that of a type.
bool can_be_c99(const std::string& name, const Span& name_span, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
