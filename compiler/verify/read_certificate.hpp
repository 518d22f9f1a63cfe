// The text of a certificate, read.
#pragma once

#include <optional>

#include "verify/certificate_file.hpp"

namespace dashpot::compiler {

// Refuses, at the place of the first fault: what is no JSON, or no certificate of this format.
std::optional<CertificateFile> read_certificate(const SourceFile& file, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
