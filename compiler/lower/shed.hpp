// A law that never asks its motor for more than it can make (theory, section 10): where the command would be beyond the
// motor's limit, or further from the last one than the motor can go in a period, all forces in the network are
// multiplied by one share in [0, 1], so that what is stored falls and the command is within. With
//     m = wanted, cut to ±limit and m₋ ± step,      s = m/wanted where wanted is beyond m, else 1,
//     F_i ← s F_i,      r ← u − s (u − r)
// where r is the rest position of the static spring. After shedding, r returns to 0 as soon as the tool lets it, and is
// never further out than the tool: r ← the median of 0, r and u; behind a contact, surface and r follow a tool that has
// left. Neither needs energy. If a command should fall faster than the motor can, it falls as fast as the motor can,
// and the states are not changed; theory calls this the shortfall.
#pragma once

#include <dashpot/command.hpp>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// What the motor can make; 0: unlimited.
struct MotorReach {
  double limit = 0;  // largest force [N]
  double step = 0;   // largest change of the force from one sample to the next [N]
};

// As long as nothing is shed, the states are the same to the last bit as without shedding. A law with tunables
// multiplies its forces by the share itself, and uses its springs' offsets in place of r.
UpdateLaw with_shedding(UpdateLaw law, const MotorReach& reach, motion port_motion);

// To be called before with_shedding() and behind_map(): writes a law with tunables so that its springs can shed. Other
// laws are returned as they are.
UpdateLaw told_of_motor(UpdateLaw law, const MotorReach& reach);

}  // namespace dashpot::compiler
