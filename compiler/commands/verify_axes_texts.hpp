// verify_texts() for laws of two axes.
#pragma once

#include "commands/commands.hpp"
#include "source/source_file.hpp"

namespace dashpot::compiler {

std::optional<std::string> verify_axes_texts(const SourceFile& certificate, const SourceFile& header,
                                             bool allow_uncertified, SourceFiles& files, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
