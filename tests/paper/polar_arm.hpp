// A parallelogram of equal links is polar: half the sum of its joints is the tip's direction, their difference its
// distance.
#pragma once

#include <dashpot/simulated/arm_scenario.hpp>

#include <cmath>

namespace dashpot::paper {

// Joints that put the tip there, at this velocity: distance 2 l cos(δ/2), joints φ ∓ δ/2.
inline simulated::joints_motion joints_of(double link, const simulated::tip_motion& tip) {
  const double(&p)[2] = tip.position, (&v)[2] = tip.velocity;
  const double distance = std::hypot(p[0], p[1]);
  const double stretching = (p[0] * v[0] + p[1] * v[1]) / distance;
  const double turning = (p[0] * v[1] - p[1] * v[0]) / (distance * distance);
  const double half = std::acos(distance / (2 * link)), opening = -stretching / (2 * link * std::sin(half));
  const double direction = std::atan2(p[1], p[0]);
  return {{direction - half, direction + half}, {turning - opening, turning + opening}};
}

}  // namespace dashpot::paper
