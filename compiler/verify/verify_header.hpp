// Whether an emitted header is what its certificate says, and the certificate what the network says.
#pragma once

#include "verify/certificate_file.hpp"
#include "verify/header_constants.hpp"

namespace dashpot::compiler {

// Inner nodes of a part, at most: 100 digits take minutes for more.
inline constexpr std::size_t most_verified_nodes = 200;

// Reports every constant that only a certificate or only the header has, or that differs.
void compare_constants(const std::map<std::string, std::vector<double>>& stated, const HeaderConstants& header,
                       Diagnostics& diagnostics);

// In: a certificate, the network in it, the device in it, and the text of a header. Recomputes every constant from the
// network in 100 digits by code of its own and requires the nearest number. Reports every disagreement. Out: how many
// constants were checked. The code around the constants is compared by its callers, who can compile the network again.
// Requires a linear network with parts no larger than that.
std::size_t verify_linear_constants(const CertificateFile& certificate, const Network& network,
                                    const PortDevice& device, const HeaderConstants& header, Diagnostics& diagnostics);

// The same of a network with slips, a contact or tunable parameters, from what it compiles to: what is chosen, as what
// the brake is given of a slip's dampers, must be as it compiles.
std::size_t verify_constants(const CertificateFile& certificate, const PortDevice& device,
                             const HeaderConstants& header, const Compilation& compiled, Diagnostics& diagnostics);

// The bounds in the certificate, recomputed from the header's constants. Those must have been found right, and so must
// the code around them: there are no bounds of any numbers whatever.
void verify_bounds(const CertificateFile& certificate, const PortDevice& device, const HeaderConstants& header,
                   const Compilation& compiled, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
