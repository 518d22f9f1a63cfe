// Templates shaped like the file that they make. `{{name}}` is a field; lines between `{{#list}}` and `{{/list}}`, each
// alone on its line, repeat for every entry of a list, with the entry's fields before those of the file.
#pragma once

#include <optional>
#include <string>

#include "emit/code_model.hpp"
#include "emit/emission.hpp"
#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// The template of that file name: from `directory` where one is given, else the one built into the compiler. Kept by
// `diagnostics`, which may point into it. Refuses, with nullptr: what cannot be read.
const SourceFile* find_template(const std::string& name, const std::optional<std::string>& directory,
                                Diagnostics& diagnostics);

// Refuses: a placeholder that the model does not have, and a field or list of the model that the template never uses.
std::optional<std::string> fill(const SourceFile& text, const CodeModel& model, Diagnostics& diagnostics);

// Both in one.
std::optional<std::string> filled(const std::string& name, const CodeModel& model,
                                  const std::optional<std::string>& directory, Diagnostics& diagnostics);
// And as a file to write behind `files`; false where it is refused.
bool append_filled(const std::string& name, std::string file, const CodeModel& model, const EmissionOptions& options,
                   std::vector<OutputFile>& files, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
