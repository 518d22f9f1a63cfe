// Limits of the extended precision, and of the dense elimination of a part.
#pragma once

#include "linear/modal_reduction.hpp"
#include "network/network.hpp"
#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// The largest ratio of two stiffnesses, or of two dampings [1]. Up to it results were compared with exact ones.
inline constexpr double widest_spread = 1e24;
// Inner nodes that springs, dampers and slips join without passing tool or ground: the work grows with their cube.
inline constexpr std::size_t most_inner_nodes = 400;

// Of the parts that are eliminated together, the one with most inner nodes; without elements where none has any.
Part largest_part(const Network& network);

// Refuses values further apart and parts with more nodes, naming the elements.
bool is_within_reach(const Network& network, Diagnostics& diagnostics, std::size_t most_nodes = most_inner_nodes);

}  // namespace dashpot::compiler
