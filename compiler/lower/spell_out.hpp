// The calls of a law whose parameters change as the statements that they stand for: springs, meshes, slips, the tank
// and the motor's limits are then states and numbers of the law like all others (theory, section 6). Decisions become
// choices between two numbers, so that but for solvers of slips a sample takes the same steps whatever the values. V +
// T never rises by more than the work that the tool does, set() included.
#pragma once

#include <dashpot/command.hpp>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// Needed before a law can be run or printed. A law without calls is returned as it is.
UpdateLaw spelled_out(UpdateLaw law, motion port_motion);

// With the values that set() and reset() at 0 would find for the initial parameters, so that a new object needs
// neither.
UpdateLaw begun_at_rest(UpdateLaw law);

}  // namespace dashpot::compiler
