// A network with all its slips stuck, as it answers a step, and with all of them open, without friction.
#pragma once

#include "network/network.hpp"

namespace dashpot::compiler {

// In: a network. Out: the same while every slip holds: nodes that slips join are one, and elements that are bridged so
// have no effect. Ensures: no slip has an effect.
Network with_stuck_slips(Network network);

// In: a network. Out: the same without slips; elements that lead from tool to ground through slips alone have no
// effect.
Network with_open_slips(Network network);

}  // namespace dashpot::compiler
