// The programs of a law with tunable parameters.
#pragma once

#include "law/update_law.hpp"

namespace dashpot::compiler {

// In: a law with its tables. Out: the same with the programs that follow from them; those that it had are left out.
// Where it sheds, the command within the motor's limits is still to be written (lower/shed.hpp), and so is the map of a
// static curve (lower/behind_map.hpp).
UpdateLaw with_programs(UpdateLaw law);

}  // namespace dashpot::compiler
