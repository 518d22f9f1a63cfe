// A law behind the map w(u) of a static curve (theory, section 11):
//
//     f = w′(u) F(w(u)),   b(u) = w′(u)² b_w,   and the estimate v̂ of u̇ becomes w′(u) v̂
//
// where F and b_w are the force and the brake command of the law behind the map.
#pragma once

#include "law/update_law.hpp"
#include "network/motion_map.hpp"

namespace dashpot::compiler {

// In: a law whose position is w, and the damping that is added to the brake at the tool [N·s/m]. Out: the same law,
// with the tool's position u as its input. The states do not change.
UpdateLaw behind_map(UpdateLaw law, const MotionMap& map, double added_damping, motion port_motion);

}  // namespace dashpot::compiler
