// Whether a law's step is a list of statements without loops of its own: what constant time and many points need.
#pragma once

#include "emit/emission.hpp"

namespace dashpot::compiler {

// True where nothing asked for stands against the law. Refuses: --constant-time and --batch for coupled slips and
// slips beside tunables, whose steps take as long as their values have it.
bool can_be_emitted(const Compilation& compilation, const EmissionOptions& options, Diagnostics& diagnostics);

// The same of C99, where the network's name is also that of a type.
bool can_be_c99(const std::string& name, const Span& name_span, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
