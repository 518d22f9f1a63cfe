// Not every shape of component needs all of its locals: takes out what nobody reads.
#pragma once

#include "discretise/update_law.hpp"

namespace dashpot::compiler {

void drop_unread_locals(UpdateLaw& law);

}  // namespace dashpot::compiler
