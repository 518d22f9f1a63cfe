// Whether an emitted header is what its certificate says, and the certificate what the network says.
#pragma once

#include "verify/certificate_file.hpp"
#include "verify/header_constants.hpp"

namespace dashpot::compiler {

// In: a certificate, the network and device in it, and the text of a header. Recomputes every constant from the network
// in 100 digits by code of its own and requires the nearest number; recomputes the bounds from the header's constants.
// Reports every disagreement. Out: how many constants were checked; empty where a header has none or the law is not
// linear. The code around the constants is compared by its callers, who can compile the network again.
std::optional<std::size_t> verify_constants(const CertificateFile& certificate, const Network& network,
                                            const PortDevice& device, const HeaderConstants& header,
                                            Diagnostics& diagnostics);

}  // namespace dashpot::compiler
