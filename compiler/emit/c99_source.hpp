// The law in C99 as a part of a longer source, for targets that put something around it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emit/code_model.hpp"
#include "emit/emission.hpp"

namespace dashpot::compiler {

// The name of the struct and the prefix of its functions: no name of a header or of a tool, whatever the network's
// name.
std::string c99_name(const Compilation& compilation);

// The whole text of <name>.h, which includes nothing. Refuses what emit_c99() refuses.
std::optional<std::string> c99_source(const Compilation& compilation, const EmissionOptions& options,
                                      Diagnostics& diagnostics);

// The text without its last end of line, as one entry of a list for a template.
std::vector<Fields> as_one_entry(std::string text);

}  // namespace dashpot::compiler
