// Templates shaped like the file that they make. `{{name}}` is a field; lines between `{{#list}}` and `{{/list}}`, each
// alone on its line, repeat for every entry of a list, with the entry's fields before those of the file.
#pragma once

#include <optional>
#include <string>

#include "emit/code_model.hpp"
#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// The template of that file name: from `directory` where one is given, else the one built into the compiler. Kept by
// `diagnostics`, which may point into it. Refuses, with nullptr: what cannot be read.
const SourceFile* find_template(const std::string& name, const std::optional<std::string>& directory,
                                Diagnostics& diagnostics);

// Refuses: a placeholder that the model does not have, and a field or list of the model that the template never uses.
std::optional<std::string> fill(const SourceFile& text, const CodeModel& model, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
