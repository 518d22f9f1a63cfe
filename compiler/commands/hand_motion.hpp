// The motion that a hand at the simulated device intends.
#pragma once

#include <dashpot/device_description.hpp>
#include <dashpot/simulated/trajectory.hpp>

namespace dashpot::compiler {

// At the tool.
struct HandMotion {
  double start;  // of the tool, at rest [m] or [rad]
  simulated::trajectory intended;
};

// Swings by 10 mm, or 0.2 rad at a bare joint, about 0, where the network is at rest: by less where the encoder's range
// asks for it. Where half of that has no room, the swing is about the middle of the range; the tool then starts at 0
// and is led there, so that nothing is loaded at the start, or, where 0 is beyond the range, starts in the middle.
HandMotion hand_motion(const device_description& device, bool rotary_tool);

}  // namespace dashpot::compiler
