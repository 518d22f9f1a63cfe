// The network as a drawing, tool on the left, ground on the right.
#pragma once

#include <string>

#include "network/network.hpp"
#include "network/tree.hpp"

namespace dashpot::compiler {

// An <svg> of its own size. A tree is drawn as it is written: series in a row, parallel one under another between two
// rails. Any other network gets a rail for each node, in layers from the tool, and a row for each chain of elements,
// ordered so that few rails cross rows. Elements without effect are left out.
std::string schematic(const Network& network);

}  // namespace dashpot::compiler
