// What `dashpot verify` does once both files are read.
#pragma once

#include "commands/commands.hpp"
#include "source/source_file.hpp"

namespace dashpot::compiler {

// In: the texts of a certificate and of a header. Out: what was found right, as one line. Refuses: texts that are no
// certificate or no header, and every disagreement between them and the network in the certificate. `files` keeps what
// the diagnostics point into.
std::optional<std::string> verify_texts(const SourceFile& certificate, const SourceFile& header, SourceFiles& files,
                                        Diagnostics& diagnostics);

}  // namespace dashpot::compiler
