#pragma once

#include "law/update_law.hpp"

namespace dashpot::compiler {

// With the values that set() and reset() at 0 would find for the initial parameters, so that a new object needs
// neither.
UpdateLaw begun_at_rest(UpdateLaw law);

}  // namespace dashpot::compiler
