// Where the tip of an arm is, and how it moves with the joints; the branch of a five-bar is the one with its elbows
// outward and the tip above them. Not finite where the arm does not reach.
#pragma once

#include <cmath>

#include <dashpot/arm_description.hpp>

namespace dashpot {

// A point of the arm: its position, ∂/∂q, and the part of its acceleration that does not come from the joints' own.
struct arm_point {
  double position[2] = {};            // [m]
  double jacobian[2][arm_axes] = {};  // [m/rad] or [1]
  double centripetal[2] = {};         // J̇ q̇ [m/s²]
};

// Of all arms but the Cartesian: the elbows, on one side or on both, and the tip.
struct arm_pose {
  arm_point elbow[2];  // serial, parallelogram: the first alone
  arm_point tip;
};

namespace detail {

// Adds a link that is turned by the angle Σ w_j q_j.
inline void add_link(arm_point& point, double length, const double (&weights)[2], const double (&q)[2],
                     const double (&v)[2]) noexcept {
  const double angle = weights[0] * q[0] + weights[1] * q[1], rate = weights[0] * v[0] + weights[1] * v[1];
  const double link[2] = {length * std::cos(angle), length * std::sin(angle)};
  for (unsigned i = 0; i < 2; ++i) {
    point.position[i] += link[i];
    for (unsigned j = 0; j < 2; ++j) point.jacobian[i][j] += weights[j] * (i == 0 ? -link[1] : link[0]);
    point.centripetal[i] -= rate * rate * link[i];
  }
}

// The tip of two distal links of the same length from two elbows, d_i·(Ṗ − Ė_i) = 0.
inline void close_chain(arm_pose& pose, double distal, const double (&v)[2]) noexcept {
  const arm_point &left = pose.elbow[0], &right = pose.elbow[1];
  const double across[2] = {right.position[0] - left.position[0], right.position[1] - left.position[1]};
  const double height = std::sqrt(distal * distal / (across[0] * across[0] + across[1] * across[1]) - 0.25);
  arm_point& tip = pose.tip;
  tip.position[0] = left.position[0] + across[0] / 2 - height * across[1];
  tip.position[1] = left.position[1] + across[1] / 2 + height * across[0];
  double d[2][2];
  for (unsigned side = 0; side < 2; ++side)
    for (unsigned i = 0; i < 2; ++i) d[side][i] = tip.position[i] - pose.elbow[side].position[i];
  const double per_area = 1 / (d[0][0] * d[1][1] - d[0][1] * d[1][0]);
  const auto solve = [&](double first, double second, double& x, double& y) {
    x = per_area * (d[1][1] * first - d[0][1] * second);
    y = per_area * (d[0][0] * second - d[1][0] * first);
  };
  const auto driven = [&](unsigned side, unsigned joint) {
    return d[side][0] * pose.elbow[side].jacobian[0][joint] + d[side][1] * pose.elbow[side].jacobian[1][joint];
  };
  for (unsigned j = 0; j < 2; ++j) solve(driven(0, j), driven(1, j), tip.jacobian[0][j], tip.jacobian[1][j]);
  double bend[2];
  for (unsigned side = 0; side < 2; ++side) {
    const arm_point& elbow = pose.elbow[side];
    bend[side] = 0;
    for (unsigned i = 0; i < 2; ++i) {
      const double apart =
          (tip.jacobian[i][0] - elbow.jacobian[i][0]) * v[0] + (tip.jacobian[i][1] - elbow.jacobian[i][1]) * v[1];
      bend[side] += d[side][i] * elbow.centripetal[i] - apart * apart;
    }
  }
  solve(bend[0], bend[1], tip.centripetal[0], tip.centripetal[1]);
}

}  // namespace detail

inline arm_pose pose_of(const arm_geometry& arm, const double (&q)[2], const double (&v)[2]) noexcept {
  arm_pose pose;
  constexpr double first[2] = {1, 0}, second[2] = {0, 1}, both[2] = {1, 1};
  switch (arm.kind) {
    case arm_kind::serial:
    case arm_kind::parallelogram:
      detail::add_link(pose.elbow[0], arm.proximal, first, q, v);
      pose.tip = pose.elbow[0];
      detail::add_link(pose.tip, arm.distal, arm.kind == arm_kind::serial ? both : second, q, v);
      break;
    case arm_kind::five_bar:
      pose.elbow[0].position[0] = -arm.base / 2;
      pose.elbow[1].position[0] = arm.base / 2;
      detail::add_link(pose.elbow[0], arm.proximal, first, q, v);
      detail::add_link(pose.elbow[1], arm.proximal, second, q, v);
      detail::close_chain(pose, arm.distal, v);
      break;
    case arm_kind::cartesian:
      for (unsigned i = 0; i < 2; ++i) pose.tip.position[i] = q[i], pose.tip.jacobian[i][i] = 1;
      break;
  }
  return pose;
}

}  // namespace dashpot
