// A law that never asks its motor for more than it can make (theory, section 10): where the command would be beyond the
// motor's limit, or further from the last one than the motor can go in a period, all forces in the network are
// multiplied by one share in [0, 1], so that what is stored falls and the command is within. With
//     m = within(wanted, ±limit, m₋ ± step),      s = m/wanted where wanted is beyond m, else 1,
//     F_i ← s F_i,      r ← u − s (u − r)
// where r is the rest position of the static spring. After shedding, r returns to 0 as soon as the tool lets it, and is
// never further out than the tool: r ← the median of 0, r and u; behind a contact, surface and r follow a tool that has
// left. Neither takes any energy. A command that ought to fall faster than the motor can is held back and the states
// are not touched: the shortfall.
#pragma once

#include <dashpot/command.hpp>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// What the motor can make; 0: unlimited.
struct MotorReach {
  double limit = 0;  // of its force [N]
  double step = 0;   // of its change from one sample to the next [N]
};

// The states stay what they were, to the last bit, as long as nothing is shed. A law that has a share already
// multiplies its forces by itself: one with tunables, with the offsets of its springs in the place of r.
UpdateLaw with_shedding(UpdateLaw law, const MotorReach& reach, motion port_motion);

// Before that, and before the law is put behind a map: a law with tunables whose springs can shed; another as it is.
UpdateLaw told_of_motor(UpdateLaw law, const MotorReach& reach);

}  // namespace dashpot::compiler
