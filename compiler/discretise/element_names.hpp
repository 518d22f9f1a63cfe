// Names in the emitted code that say which elements of the author they come from.
#pragma once

#include <string>
#include <vector>

#include "law/update_law.hpp"
#include "network/network.hpp"
#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// "B1_K1" for B1 and K1; a long list is cut to its ends, "B1_to_K9".
std::string name_of(const std::vector<std::size_t>& elements, const Network& network);

// False, with a diagnostic, if the emitted class has the same name as one of its members: C++ would take that member
// for a constructor.
bool class_differs_from_members(const UpdateLaw& law, const Network& network, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
