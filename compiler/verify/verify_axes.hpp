// Whether a header of two axes is what its certificate says, and the certificate what network and device say.
#pragma once

#include "verify/axes_certificate_file.hpp"
#include "verify/header_constants.hpp"
#include "verify/reference_arm.hpp"

namespace dashpot::compiler {

// In: a certificate, a header's constants, and what network and device of the certificate compile to. The constants of
// every port are recomputed in 100 digits as those of a law of one axis, and those of device and maps; numbers that
// have no name of their own, as products of the geometry, must be those that the compiler writes again. Reports every
// disagreement. Out: how many constants were checked.
std::size_t verify_axes_constants(const AxesCertificateFile& certificate, const HeaderConstants& header,
                                  const AxesCompilation& compiled, Diagnostics& diagnostics);

// The bounds, recomputed over the whole workspace to the last bit, and not below what is needed at places of it. Out:
// what is needed there; nothing where nothing is proved, as without a device.
std::optional<NeedAtPlaces> verify_axes_bounds(const AxesCertificateFile& certificate, const AxesCompilation& compiled,
                                               Diagnostics& diagnostics);

}  // namespace dashpot::compiler
