// A device of two axes in numbers: an arm with a joint at each of two motors, and brakes along constant directions of
// joint velocities. All in SI; the joints' coordinates are [rad], [N·m] for every arm but the Cartesian one, whose are
// [m], [N]. Plain data, no heap, as device_description.hpp.
#pragma once

#include <dashpot/device_description.hpp>

namespace dashpot {

inline constexpr unsigned arm_axes = 2;
inline constexpr unsigned most_arm_brakes = 4;

// All angles are counterclockwise from the x axis; both links lie in the plane.
enum class arm_kind : unsigned char {
  serial,         // q1 the first link's angle, q2 the second's from the first
  parallelogram,  // q1 and q2 the angles of both links, each driven from the ground
  five_bar,       // motor axes at (∓base/2, 0), q1 the left and q2 the right proximal link's angle, the tip above
  cartesian,      // q is the tip's position itself
};

struct arm_geometry {
  arm_kind kind = arm_kind::cartesian;
  double proximal = 1;            // link at the motors [m]
  double distal = 1;              // link at the tip [m]
  double base = 0;                // five_bar: distance of the motor axes [m]
  double workspace_low[2] = {};   // least x and y of the tip [m]; low == high: unlimited
  double workspace_high[2] = {};  // [m]
};

struct arm_brake {
  double along[arm_axes] = {};  // acts on along·q̇, as written [1]
  brake_description brake;      // in the joints' unit
};

struct arm_description {
  arm_geometry geometry;
  // Motion, loop, encoder, velocity, motor, and of `mechanics` friction and damping of each; the loop is that of both.
  device_description joints[arm_axes];
  unsigned brake_count = 0;
  arm_brake brakes[most_arm_brakes];
  double inertia[arm_axes][arm_axes] = {};  // at the joints, symmetric [kg·m²] or [kg]; 0: that of the links
  double link_masses[2] = {};               // of uniform links, proximal and distal, both sides alike [kg]

  constexpr dashpot::motion motion() const noexcept { return joints[0].motion; }
  constexpr const loop_description& loop() const noexcept { return joints[0].loop; }
};

// One joint's motor, and one brake on a coordinate of its own, as the parts for one axis take them.
constexpr device_description joint_of(const arm_description& arm, unsigned joint) noexcept {
  device_description one = arm.joints[joint];
  one.brake = {};
  return one;
}
constexpr device_description brake_of(const arm_description& arm, unsigned brake) noexcept {
  device_description one;
  one.motion = arm.motion();
  one.loop = arm.loop();
  one.brake = brake < arm.brake_count ? arm.brakes[brake].brake : brake_description{};
  return one;
}

}  // namespace dashpot
