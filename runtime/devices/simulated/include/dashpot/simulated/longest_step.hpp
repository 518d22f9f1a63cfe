// How long an integration step of the plant may be [s].
//
// scenario::substeps of them make a period where that is stated. Otherwise a step is half of what the fastest of these
// takes, and no longer than a period, no shorter than a 64th of it: the actuators' lags, the damping rate and the
// natural frequency (five times as fast, for its phase) with everything engaged, that of a structural mode, the hand's
// own rates. A step of half a time constant is wrong by (½)⁵/720 of what happens within it, and the error falls with
// the fourth power.
#pragma once

#include <dashpot/device_description.hpp>
#include <dashpot/simulated/scenario.hpp>

namespace dashpot::simulated {

// `user` in the joint's coordinate; `ratio` tool motion over joint motion.
double longest_step(const device_description& device, const scenario& scene, const hand& user, double ratio);

}  // namespace dashpot::simulated
