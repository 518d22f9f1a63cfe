// Whether a network hangs together.
#pragma once

#include <vector>

#include "network/network.hpp"
#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// In: a network whose elements and nodes are complete. Refuses: tool or ground without an element, no connection from
// one to the other, parts connected to neither, slips that join tool and ground by themselves (theory, section 5).
// `node_places`: where each node is first named.
void check_connections(const Network& network, Span structure, const std::vector<Span>& node_places,
                       Diagnostics& diagnostics);

// Marks the elements without effect, and warns about each.
void mark_effect(Network& network, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
