// From the text of a network file to what its author wrote (architecture, section 3; networks/README.md).
#pragma once

#include <optional>

#include "source/diagnostic.hpp"
#include "syntax/json.hpp"
#include "syntax/network_decl.hpp"

namespace dashpot::compiler {

// In: a network file of format 1. Out: its declaration. Ensures: keys known and of the right type, unless `complete` is
// false. Refuses: what is not JSON, not a network file, or another format; everything else is reported and survives as
// an incomplete declaration, so that build_network can find further problems.
std::optional<NetworkDecl> parse_network(const SourceFile& file, Diagnostics& diagnostics);

// Of an object with keys of a network file: of a port of a network of two axes.
NetworkDecl parse_network_object(const JsonValue& object, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
