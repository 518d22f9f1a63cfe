// The programs of a law with tunable parameters.
#pragma once

#include "law/update_law.hpp"

namespace dashpot::compiler {

// In: a law with its tables. Out: the same law with programs written from the tables; earlier programs are dropped. Two
// things are still to be written: the command within the motor's limits, if the law sheds (lower/shed.hpp), and the map
// of a static curve (lower/behind_map.hpp).
UpdateLaw with_programs(UpdateLaw law);

}  // namespace dashpot::compiler
