// An obstacle in the tool's way: a rigid one that takes all its momentum, or a Kelvin body that is never adhesive.
#pragma once

#include <limits>

namespace dashpot::simulated {

struct end_stop {
  double position = 0;                                         // of the surface, at the tool [m] or [rad]
  double stiffness = std::numeric_limits<double>::infinity();  // [N/m] or [N·m/rad]; infinite: rigid and inelastic
  double damping = 0;                                          // [N·s/m] or [N·m·s/rad]; of no effect when rigid
};

}  // namespace dashpot::simulated
