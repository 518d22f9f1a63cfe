// The static curve of a network file.
#pragma once

#include <optional>

#include "syntax/json.hpp"
#include "syntax/network_decl.hpp"

namespace dashpot::compiler {

// In: the value of `static`, an object. Refuses: no kind or two, keys of another kind, rows of a table that are no
// pairs.
std::optional<StaticDecl> parse_static(const JsonValue& value, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
