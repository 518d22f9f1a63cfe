// What a law was made from, as its certificate states it: the choices, and the network whose canonical form its modes
// are taken from.
#pragma once

#include "verify/certificate_file.hpp"
#include "verify/reference_constants.hpp"

namespace dashpot::compiler {

LawFacts facts_of(const CertificateFile& certificate);

// With nodal states, the network rewired so that the observed elements are next to the tool; else the network itself.
Network realised(const Network& network, const CertificateFile& certificate, const PortDevice& device);

}  // namespace dashpot::compiler
