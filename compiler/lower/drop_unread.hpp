// Removes locals that nothing reads: some kinds of law write more of them than they need.
#pragma once

#include "law/update_law.hpp"

namespace dashpot::compiler {

UpdateLaw without_unread_locals(UpdateLaw law);

}  // namespace dashpot::compiler
