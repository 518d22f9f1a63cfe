// A law whose brake is told more, for passivity alone.
#pragma once

#include "law/update_law.hpp"

namespace dashpot::compiler {

// The same law with its brake's command raised in every regime, by a number of the scalar's type [N·s/m]. In: a law
// whose brake changes.
UpdateLaw with_steady_damping(UpdateLaw law, double damping);

}  // namespace dashpot::compiler
