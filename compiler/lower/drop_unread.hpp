// Not every shape of component needs all of its locals: takes out what nobody reads.
#pragma once

#include "law/update_law.hpp"

namespace dashpot::compiler {

UpdateLaw without_unread_locals(UpdateLaw law);

}  // namespace dashpot::compiler
