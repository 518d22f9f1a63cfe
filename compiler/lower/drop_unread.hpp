// Removes locals that nobody reads: not every shape of component needs all of them.
#pragma once

#include "law/update_law.hpp"

namespace dashpot::compiler {

UpdateLaw without_unread_locals(UpdateLaw law);

}  // namespace dashpot::compiler
