// What another candidate would do better than the chosen one. The user's choice stands.
#pragma once

#include <string>
#include <vector>

#include "decompose/decomposition.hpp"

namespace dashpot::compiler {

// `damping_unit`: of the port. One clause each, at most one for the minimum damping, one for the motor's noise, and one
// for each component with slips.
std::vector<std::string> notes_on_choice(const Decomposition& decomposition, const std::string& damping_unit);

}  // namespace dashpot::compiler
