#pragma once

#include "law/update_law.hpp"

namespace dashpot::compiler {

// Gives states and tuned variables the values that set() and reset() at 0 would give them, so that a new object needs
// neither call.
UpdateLaw begun_at_rest(UpdateLaw law);

}  // namespace dashpot::compiler
