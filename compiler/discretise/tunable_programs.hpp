// The programs of a law with tunable parameters: what is remembered from sample to sample, around calls for its tables.
#pragma once

#include <dashpot/command.hpp>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// In: a law with its tables, and without programs. Out: the same with them. `behind_curve`: a static curve's map will
// be written in front of it.
UpdateLaw with_programs(UpdateLaw law, motion port_motion, bool behind_curve);

}  // namespace dashpot::compiler
