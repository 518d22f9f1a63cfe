// How the tip's motion bends with the joints, and where the arm is singular. For certificates, searches and drawings:
// no law needs them. Any scalar, as kinematics.hpp.
#pragma once

#include "axes/kinematics.hpp"

namespace dashpot::compiler::axes {

// Along joint j and k, with J_j the columns of J and E_i the elbows, each of which joint i alone moves:
//
//     d_i·tip_jk = −(J_j − δ_ij E_i′)·(J_k − δ_ik E_i′) + δ_ij δ_ik d_i·E_i″,     E_i″ = −(proximal link i)
template <typename S>
S five_bar_row(const FiveBar<S>& bar, const Pose<S>& pose, std::size_t i, std::size_t j, std::size_t k) {
  const Pair<S> swing = turned(bar.proximal[i]);
  const Pair<S> first = i == j ? pose.column[j] - swing : pose.column[j];
  if (j != k) return S(-1) * dot(first, i == k ? pose.column[k] - swing : pose.column[k]);
  const S turning = S(-1) * length_squared(first);
  return i == j ? turning - dot(bar.distal[i], bar.proximal[i]) : turning;
}

template <typename S>
Pair<Symmetric<S>> five_bar_curvature(const FiveBar<S>& bar) {
  const Pose<S> pose = pose_of(bar);
  const auto second = [&](std::size_t j, std::size_t k) {
    return solve_distal(bar, five_bar_row(bar, pose, 0, j, k), five_bar_row(bar, pose, 1, j, k));
  };
  const Pair<S> first = second(0, 0), mixed = second(0, 1), last = second(1, 1);
  return {Symmetric<S>{first[0], mixed[0], last[0]}, Symmetric<S>{first[1], mixed[1], last[1]}};
}

// Second derivatives of the tip's x and of its y with q [m/rad²].
template <typename S>
Pair<Symmetric<S>> curvature(const Arm& arm, const Pair<S>& q) {
  const S none(0);
  switch (arm.kind) {
    case Kinematics::serial: {
      const Pair<S> far = link(arm.distal, q[0] + q[1]), tip = link(arm.proximal, q[0]) + far;
      return {Symmetric<S>{-tip[0], -far[0], -far[0]}, Symmetric<S>{-tip[1], -far[1], -far[1]}};
    }
    case Kinematics::parallelogram: {
      const Pair<S> near = link(arm.proximal, q[0]), far = link(arm.distal, q[1]);
      return {Symmetric<S>{-near[0], none, -far[0]}, Symmetric<S>{-near[1], none, -far[1]}};
    }
    case Kinematics::five_bar: return five_bar_curvature(five_bar(arm, q));
    case Kinematics::cartesian: break;
  }
  return {Symmetric<S>{none, none, none}, Symmetric<S>{none, none, none}};
}

// det J [m²/rad²], or 1 for cartesian; for the five-bar with the sign that it has with the elbows outward turned
// positive.
template <typename S>
S determinant(const Arm& arm, const Pair<S>& q) {
  using std::sin;
  switch (arm.kind) {
    case Kinematics::serial: return S(arm.proximal * arm.distal) * sin(q[1]);
    case Kinematics::parallelogram: return S(arm.proximal * arm.distal) * sin(q[1] - q[0]);
    case Kinematics::five_bar: {
      const FiveBar<S> bar = five_bar(arm, q);
      return bar.reciprocal * dot(turned(bar.distal[0]), bar.proximal[0]) * dot(bar.distal[1], turned(bar.proximal[1]));
    }
    case Kinematics::cartesian: break;
  }
  return S(1);
}

// Hessian in q of a map of the tip that has a gradient and a Hessian there [unit of the map/rad²]:
//
//     ∂²w/∂q² = Jᵀ (∂²w/∂x²) J + Σ_x (∂w/∂x) ∂²x/∂q²
template <typename S>
Symmetric<S> at_joints(const Pose<S>& pose, const Pair<Symmetric<S>>& curvature, const Pair<S>& gradient,
                       const Symmetric<S>& hessian) {
  return at_joints(pose, hessian) + gradient[0] * curvature[0] + gradient[1] * curvature[1];
}

}  // namespace dashpot::compiler::axes
