// The text of a certificate, read.
#pragma once

#include <optional>

#include "verify/axes_certificate_file.hpp"
#include "verify/certificate_file.hpp"

namespace dashpot::compiler {

// Refuses, at the place of the first fault: what is no JSON, or no certificate of this format.
std::optional<CertificateFile> read_certificate(const SourceFile& file, Diagnostics& diagnostics);

// The same of one of two axes.
std::optional<AxesCertificateFile> read_axes_certificate(const SourceFile& file, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
