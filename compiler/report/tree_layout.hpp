// A tree as nested rows and stacks.
#pragma once

#include "network/tree.hpp"
#include "report/schematic_frame.hpp"

namespace dashpot::compiler {

Inside tree_layout(const Tree& tree, const Network& network);

}  // namespace dashpot::compiler
