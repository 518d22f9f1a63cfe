// Motions as functions of time: what a hand intends, or what the tool is made to do. In the tool's coordinate.
#pragma once

#include <functional>
#include <vector>

namespace dashpot::simulated {

struct motion_point {
  double position = 0;  // [m] or [rad]
  double velocity = 0;  // [m/s] or [rad/s]; right limit where it jumps
};

// Must neither throw nor allocate when called. `time` ≥ 0 [s].
using trajectory = std::function<motion_point(double time)>;

struct knot {
  double time;      // [s]
  double position;  // [m] or [rad]
};

trajectory hold_at(double position);

// centre + amplitude · sin(2π frequency · t + phase); frequency [Hz], phase [rad].
trajectory sine(double amplitude, double frequency, double phase = 0, double centre = 0);

// Straight from knot to knot, at rest before the first and after the last. Times must grow; at least one knot.
trajectory through(std::vector<knot> knots);

// As through(), with the path of least jerk between knots and rest at each (Flash & Hogan 1985):
// s(τ) = 10 τ³ − 15 τ⁴ + 6 τ⁵.
trajectory smoothly_through(std::vector<knot> knots);

}  // namespace dashpot::simulated
