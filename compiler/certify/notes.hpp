// Notes on what another candidate would do better than the chosen one; they do not change the user's choice.
#pragma once

#include <string>
#include <vector>

#include "decompose/decomposition.hpp"

namespace dashpot::compiler {

// One clause each, at most one for the minimum damping, one for the motor's noise, and one for each component with
// slips. None where parameters are tunable: what the others need is then not known.
std::vector<std::string> notes_on_choice(const Decomposition& decomposition, const Network& network);

}  // namespace dashpot::compiler
