// The part of the plane in which a device is used, and its joints there.
#pragma once

#include <optional>
#include <vector>

#include "axes/interval.hpp"
#include "axes/kinematics.hpp"
#include "axes/sloped.hpp"

namespace dashpot::compiler::axes {

// Both halves of a part of a box, across the side that is longer as a share of the whole's.
Pair<Box> halves(const Box& part, const Box& whole);

// The joints that put the tip there, on the branch that kinematics.hpp states; nothing where links cannot reach. The
// direction from a motor axis to the tip is taken from (−π, π], so that angles jump by a turn left of the axis.
std::optional<Pair<double>> joints_at(const Arm& arm, const Pair<double>& tip);

// A box that holds the joints of every tip in a box; nothing where it cannot be told that all of them are reached, or
// where the box surrounds a motor axis.
std::optional<Box> joints_over(const Arm& arm, const Box& tip);

// The same with the joints' derivatives.
std::optional<Pair<Sloped>> enclosed_joints(const Arm& arm, const Pair<Sloped>& tip);

// How the tip moves where joints put it there.
struct TipMotion {
  Pose<Sloped> pose;
  Pair<Symmetric<Sloped>> bends;  // ∂²tip/∂q²
};
TipMotion tip_motion(const Arm& arm, const Pair<Sloped>& joints, const Pair<Sloped>& tip);

// A tip position in a workspace near which the arm is singular: links that are too short or too long to reach it, or
// two of them in line, so that a motion of the tip or a force at it is beyond all bounds.
struct Singularity {
  enum class Kind { out_of_reach, too_close, in_line } kind;
  Pair<double> tip;  // [m]
};

// The workspace is halved until det J is bounded away from zero over each part; parts narrower than 1/1024 of it, where
// it cannot be, are called singular. Nothing where the arm is regular: then joints_over() has a value for every part
// that small.
std::optional<Singularity> singularity(const Arm& arm, const Box& workspace);

// A box of joints that holds those of a workspace without singularities, taken by parts of 1/32 of either side; without
// a jump [rad].
Box joint_ranges(const Arm& arm, const Box& workspace);

// A joint position and the area of workspace that it stands for [m²].
struct Place {
  Pair<double> joints;
  double area;
};

// Centres of n × n equal parts of a workspace; parts that are not reached are left out.
std::vector<Place> places_in(const Arm& arm, const Box& workspace, int n);

}  // namespace dashpot::compiler::axes
