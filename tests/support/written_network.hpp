// Networks as a user would write them, for tests of the stages behind the front end.
#pragma once

#include <string>

#include "network/network.hpp"

namespace dashpot::testing {

// In: the value of `network`, an object such as {"series": [{"spring": 50}, {"damper": 5}]}, or that of `elements`, a
// list. Values in SI. Throws std::invalid_argument with the diagnostics where the front end refuses it.
compiler::Network written_network(const std::string& structure);

}  // namespace dashpot::testing
