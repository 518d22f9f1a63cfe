// A network as it answers a step: its slips hold.
#pragma once

#include "network/network.hpp"

namespace dashpot::compiler {

// In: a network. Out: the same while every slip holds: nodes that slips join are one, and elements that are bridged so
// have no effect. Ensures: no slip has an effect.
Network with_stuck_slips(Network network);

}  // namespace dashpot::compiler
