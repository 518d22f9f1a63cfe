// What a file may hold anywhere without meaning anything: "comment" for people and "$schema" for editors.
#pragma once

#include <vector>

#include "syntax/json.hpp"
#include "syntax/network_decl.hpp"

namespace dashpot::compiler {

// Takes both keys out of every object of `root`, so that no reader has to know them. Out: the comments in file order.
// Refuses: a comment that is neither a string nor a list of strings, a schema that is no string.
std::vector<CommentDecl> take_annotations(JsonValue& root, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
