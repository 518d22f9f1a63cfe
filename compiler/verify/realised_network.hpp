// The network whose canonical form a law's modes are taken from.
#pragma once

#include "verify/certificate_file.hpp"

namespace dashpot::compiler {

// For nodal states, the network rewired so that the observed elements are next to the tool; else the network itself.
Network realised(const Network& network, const CertificateFile& certificate, const PortDevice& device);

}  // namespace dashpot::compiler
