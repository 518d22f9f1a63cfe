// Names in the emitted code that say which elements of the author they come from.
#pragma once

#include <string>
#include <vector>

#include "network/network.hpp"

namespace dashpot::compiler {

// "B1_K1" for B1 and K1; a long list is cut to its ends, "B1_to_K9".
std::string name_of(const std::vector<std::size_t>& elements, const Network& network);

}  // namespace dashpot::compiler
