// The calls of a law whose parameters change as the statements that they stand for: springs, meshes, slips, the tank
// and the motor's limits are then states and numbers of the law like all others (theory, section 6). Decisions become
// choices between two numbers, so that but for solvers of slips a sample takes the same steps whatever the values. V +
// T never rises by more than the work that the tool does, set() included.
#pragma once

#include <dashpot/command.hpp>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// Before this a law cannot be run or printed. Of a law without calls that law.
UpdateLaw spelled_out(UpdateLaw law, motion port_motion);

// With what set() and reset() at 0 find for the values that are there to begin with, so that a new object needs
// neither.
UpdateLaw begun_at_rest(UpdateLaw law);

}  // namespace dashpot::compiler
