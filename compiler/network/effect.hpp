// Which elements can carry force between tool and ground.
#pragma once

#include <cstddef>
#include <vector>

#include "network/network.hpp"

namespace dashpot::compiler {

// One entry an element: true where some path without repeated nodes leads from tool to ground through it, along
// elements for which `passable` is true. Ensures: linear in the size of the network. By the blocks of the graph with
// one more edge from tool to ground (Hopcroft & Tarjan 1973): an element lies on such a path exactly when it shares a
// block with that edge.
std::vector<bool> on_path_between_ends(const Network& network, const std::vector<bool>& passable);

// The same network, in which these elements alone have an effect.
Network with_effect_of(const std::vector<std::size_t>& elements, Network network);

// The same network, in which only elements on such a path have an effect.
Network along(const std::vector<bool>& passable, Network network);

// One entry an element: false where its value is zero and cannot become anything else.
std::vector<bool> may_carry_force(const Network& network);

// The same network, with elements that transmit no force at the tunables' default values marked as without effect.
Network at_default(const Network& network);

}  // namespace dashpot::compiler
