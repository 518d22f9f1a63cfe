// Viscous fields, force = A ẋ over the plane [N·s/m]: what of them is refused, how they are split between brakes and
// motors, and the gate that keeps the rest passive on a sampled loop (theory, section 12).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "axes/kinematics.hpp"

namespace dashpot::compiler::axes {

template <typename S>
using Matrix = std::array<std::array<S, 2>, 2>;  // by rows

// A field that drives the tool somewhere.
struct Driving {
  Pair<double> direction;  // of a velocity, of length 1
  double power;            // what it gives at 1 m/s there [W], positive
};

// Where A + Aᵀ is not positive semi-definite: the direction that it drives most. Slack for the rounding of decimals is
// 1e-12 of A.
std::optional<Driving> driving(const Matrix<double>& viscous);

// A force K x from position has a curl k21 − k12 [N/m] where K is not symmetric: round a loop of area S it gives that
// times S. Nothing where it is symmetric.
std::optional<double> curl_in_position(const Matrix<double>& stiffness);

// JᵀAJ = [[p, r + σ], [r − σ, s]] [N·m·s/rad].
template <typename S>
struct JointField {
  S p, r, s, sigma;
};

template <typename S>
JointField<S> at_joints(const Pose<S>& pose, const Matrix<S>& a) {
  const auto element = [&](std::size_t i, std::size_t j) {
    const Pair<S>& right = pose.column[j];
    return dot(pose.column[i],
               Pair<S>{a[0][0] * right[0] + a[0][1] * right[1], a[1][0] * right[0] + a[1][1] * right[1]});
  };
  const S upper = element(0, 1), lower = element(1, 0);
  return {element(0, 0), S(0.5) * (upper + lower), element(1, 1), S(0.5) * (upper - lower)};
}

// With brakes d = (p, s) on the joints and the motors making the rest from estimates of each joint's own velocity:
//
//     max(|r_k|, |σ_k|) ≤ (1 − ε)(h/T_max) min_{j = 0 … N} min(d_1(k − j)/ω, ω d_2(k − j))
//
// One sample's share of the minimum. ω > 0 is any constant, N the samples that the estimators and the loop's delay
// remember.
template <typename S>
S gate_term(const S& first_brake, const S& second_brake, double omega) {
  using std::min;
  return min(S(1 / omega) * first_brake, S(omega) * second_brake);
}

// `terms` of samples k − N … k; `factor` is (1 − ε) h/T_max.
template <typename S>
S gate(const std::vector<S>& terms, double factor) {
  using std::min;
  S least = terms.front();
  for (const S& term : terms) least = min(least, term);
  return S(factor) * least;
}

// What the motors may make of a coupling r or a curl σ.
template <typename S>
S gated(const S& wanted, const S& gate) {
  using std::min, std::max;
  return max(min(wanted, gate), S(-1) * gate);
}

// The ω with which the brakes' dampings of a field over a set of poses leave the gate widest against what it has to
// pass.
double gate_ratio(const std::vector<JointField<double>>& fields);

}  // namespace dashpot::compiler::axes
