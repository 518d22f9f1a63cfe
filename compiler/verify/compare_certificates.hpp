// Compares a certificate with the one that its own network and device give.
#pragma once

#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// Reports the first value of `stated` that is not that of `again`, with its place; where keys stand does not matter.
// Numbers agree to 1e-9 of themselves: what must be exact is compared with the header and the bounds. Two things may
// differ: by which version of dashpot it was written, and the frequency at which a bound was found, which a last bit
// may move.
void compare_certificates(const SourceFile& stated, const SourceFile& again, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
