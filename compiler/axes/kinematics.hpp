// Where the tip of a device with two motors is, and how it moves with them. All angles are counterclockwise from the
// x axis; both links lie in the plane.
//
//   serial         q1 the first link's angle, q2 the second's from the first: 0 < q2 < π inside a workspace
//   parallelogram  q1 and q2 the angles of both links, each driven from the ground: 0 < q2 − q1 < π
//   five_bar       motor axes at (−base/2, 0) and (base/2, 0), q1 the left and q2 the right proximal link's angle;
//                  elbows outward, the tip on the side of positive y. With base 0 the motors are coaxial
//   cartesian      q is the tip's position itself [m]
//
// One source for every scalar (pair.hpp): doubles, enclosures over boxes of q, and the operations of a law. No branch
// depends on a value. pose() divides for the five-bar alone: by the squared distance of the elbows and by the height of
// the tip above them, both positive where arm and workspace have been found regular (workspace.hpp).
#pragma once

#include "axes/pair.hpp"

namespace dashpot::compiler::axes {

enum class Kinematics { serial, parallelogram, five_bar, cartesian };

struct Arm {
  Kinematics kind = Kinematics::cartesian;
  double proximal = 1;  // link at the motors [m]; 1 for cartesian
  double distal = 1;    // link at the tip [m]
  double base = 0;      // five_bar: distance of the motor axes [m]
};

template <typename S>
struct Pose {
  Pair<S> tip;           // [m]
  Pair<Pair<S>> column;  // ∂tip/∂q1 and ∂tip/∂q2, the columns of the Jacobian J [m/rad], or [1] for cartesian
};

// What a link of a length adds to the tip at an angle.
template <typename S>
Pair<S> link(double length, const S& angle) {
  using std::cos, std::sin;
  return {S(length) * cos(angle), S(length) * sin(angle)};
}

// Of a five-bar: proximal links, distal links as vectors to the tip, the tip, and 1/(d1 × d2).
template <typename S>
struct FiveBar {
  Pair<Pair<S>> proximal, distal;
  Pair<S> tip;
  S reciprocal;
};

// Halfway between the elbows and up: e from the left elbow to the right one, t = √(l2²/e² − ¼), tip = middle + t
// turned(e).
template <typename S>
FiveBar<S> five_bar(const Arm& arm, const Pair<S>& q) {
  using std::sqrt;
  const Pair<S> left = link(arm.proximal, q[0]), right = link(arm.proximal, q[1]);
  const Pair<S> between{S(arm.base) + (right[0] - left[0]), right[1] - left[1]};
  const S inverse = S(1) / length_squared(between);
  const S height = sqrt(S(arm.distal * arm.distal) * inverse - S(0.25));
  const Pair<S> up = height * turned(between), half = S(0.5) * between;
  const Pair<S> first = half + up;
  return {
      {left, right}, {first, up - half}, {left[0] + first[0] - S(arm.base / 2), left[1] + first[1]}, inverse / height};
}

// The same where the tip is known beside the joints that put it there: enclosures of it then need no root.
template <typename S>
FiveBar<S> five_bar(const Arm& arm, const Pair<S>& q, const Pair<S>& tip) {
  const Pair<S> left = link(arm.proximal, q[0]), right = link(arm.proximal, q[1]), half{S(arm.base / 2), S(0)};
  const Pair<S> first = tip + half - left, second = tip - half - right;
  return {{left, right}, {first, second}, tip, S(1) / dot(turned(first), second)};
}

// The tip's motion tip′ of which d_0·tip′ is `first` and d_1·tip′ `second`, with d_i the distal links. These keep their
// lengths, so that d_i·tip′ is d_i·E_i′ of the elbow E_i where the link begins. By Cramer's rule.
template <typename S>
Pair<S> solve_distal(const FiveBar<S>& bar, const S& first, const S& second) {
  return (bar.reciprocal * first) * turned(S(-1) * bar.distal[1]) + (bar.reciprocal * second) * turned(bar.distal[0]);
}

template <typename S>
Pose<S> pose_of(const FiveBar<S>& bar) {
  const S left = dot(bar.distal[0], turned(bar.proximal[0])), right = dot(bar.distal[1], turned(bar.proximal[1]));
  return {bar.tip,
          {(bar.reciprocal * left) * turned(S(-1) * bar.distal[1]), (bar.reciprocal * right) * turned(bar.distal[0])}};
}

template <typename S>
Pose<S> pose(const Arm& arm, const Pair<S>& q) {
  switch (arm.kind) {
    case Kinematics::serial: {
      const Pair<S> far = link(arm.distal, q[0] + q[1]);
      const Pair<S> tip = link(arm.proximal, q[0]) + far;
      return {tip, {turned(tip), turned(far)}};
    }
    case Kinematics::parallelogram: {
      const Pair<S> near = link(arm.proximal, q[0]), far = link(arm.distal, q[1]);
      return {near + far, {turned(near), turned(far)}};
    }
    case Kinematics::five_bar: return pose_of(five_bar(arm, q));
    case Kinematics::cartesian: break;
  }
  return {q, {Pair<S>{S(1), S(0)}, Pair<S>{S(0), S(1)}}};
}

// Jᵀ a: what a force at the tip [N] is at the motors [N·m], and what the gradient of a map of the tip is in q.
template <typename S>
Pair<S> at_joints(const Pose<S>& pose, const Pair<S>& a) {
  return {dot(pose.column[0], a), dot(pose.column[1], a)};
}

// Jᵀ m J.
template <typename S>
Symmetric<S> at_joints(const Pose<S>& pose, const Symmetric<S>& m) {
  return {form(pose.column[0], m, pose.column[0]), form(pose.column[0], m, pose.column[1]),
          form(pose.column[1], m, pose.column[1])};
}

}  // namespace dashpot::compiler::axes
