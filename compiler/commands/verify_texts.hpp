// What `dashpot verify` does once both files are read.
#pragma once

#include "commands/commands.hpp"
#include "source/source_file.hpp"

namespace dashpot::compiler {

// In: the texts of a certificate and of a header. Out: what was found right, as one line. Refuses: texts that are no
// certificate or no header, every disagreement between them and the network in the certificate, and, unless that is
// allowed, what is sound and not certified. `files` keeps what the diagnostics point into.
std::optional<std::string> verify_texts(const SourceFile& certificate, const SourceFile& header, bool allow_uncertified,
                                        SourceFiles& files, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
