// The two ways to write a network: a tree of series and parallel, or a list of elements between named nodes.
#pragma once

#include <vector>

#include "syntax/json.hpp"
#include "syntax/network_decl.hpp"

namespace dashpot::compiler {

// Branches that are not understood are reported and left out.
std::optional<TreeDecl> parse_tree(const JsonValue& value, Diagnostics& diagnostics);
std::vector<EdgeDecl> parse_netlist(const JsonValue& list, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
