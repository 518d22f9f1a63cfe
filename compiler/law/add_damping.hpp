// Adds damping to a law's brake command for passivity.
#pragma once

#include "law/update_law.hpp"

namespace dashpot::compiler {

// In: a law whose brake changes, a number of the scalar's type [N·s/m]. Out: the same law with the brake's command
// raised by it in every regime.
UpdateLaw with_steady_damping(UpdateLaw law, double damping);

}  // namespace dashpot::compiler
