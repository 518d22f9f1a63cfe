// All files or none.
#pragma once

#include <string>
#include <vector>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// Writes beside each target first, then renames: a reader sees an old or a new file, never half of one, and a failure
// before the renames leaves all as it was, as does a signal that ends the process. Creates the folder. A link is
// followed, a pipe or a device written into, before anything is renamed. Reports what could not be written, and why.
bool write_files(const std::string& folder, const std::vector<OutputFile>& files, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
