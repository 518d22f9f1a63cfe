// A network that is no tree: a rail for each node, a row for each chain of elements.
#pragma once

#include "report/schematic_frame.hpp"

namespace dashpot::compiler {

Inside rail_layout(const Network& network);

}  // namespace dashpot::compiler
