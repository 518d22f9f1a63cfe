// Calls of dashpot::tunable_law as the statements that it would run, in their order: springs, meshes, the tank and the
// motor's limits are then states and numbers of the law like all others. Decisions become choices between two numbers,
// so that a sample takes the same steps whatever the values.
#pragma once

#include <dashpot/command.hpp>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// The same law to the bit. Of a law without calls that law.
UpdateLaw spelled_out(UpdateLaw law, motion port_motion);

}  // namespace dashpot::compiler
