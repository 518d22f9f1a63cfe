// Diagnostics as people and editors read them.
#pragma once

#include <string>

#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// `path:line:column: severity: text [code]`, the source line, the place underlined, then the notes likewise.
std::string render_text(const Diagnostics& diagnostics);

// A JSON array of {file, line, column, end_line, end_column, severity, code, message, notes: […]}, 1-based places;
// file and places are null for a diagnostic without a place.
std::string render_json(const Diagnostics& diagnostics);

// The same of a command line that could not be read at all: an array of one error without a place, its code
// "command-line".
std::string command_line_fault_as_json(const std::string& message);

}  // namespace dashpot::compiler
