// What a certificate states, against the same network compiled once more.
#pragma once

#include "compile.hpp"
#include "verify/certificate_file.hpp"
#include "verify/reference_gain.hpp"

namespace dashpot::compiler {

// Reports a number that is not the one found, to the last bit.
void expect_bound(const char* what, double stated, double found, Diagnostics& diagnostics);

// Reports every disagreement: dampings, proof, and the gain from the encoder's step, which has to agree with `gain` as
// well.
void compare_with_recompiled(const CertificateFile& certificate, const Compilation& again,
                             const std::optional<ReferenceGain>& gain, ScalarType scalar, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
