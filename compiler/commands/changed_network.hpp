// What --name and --set change in a network before it is read.
#pragma once

#include <string>

#include "commands/commands.hpp"

namespace dashpot::compiler {

// The file with the name and the values that the command line gives it, as if they stood in it, so that everything that
// is made of the network, certificates too, is of the changed one. Null where the file cannot be read; a change that
// does not fit is reported (a name that nothing has, words that are not NAME=VALUE), what is no JSON is left to the
// parser.
const SourceFile* open_network(const std::string& path, const Options& options, SourceFiles& files,
                               Diagnostics& diagnostics);

}  // namespace dashpot::compiler
