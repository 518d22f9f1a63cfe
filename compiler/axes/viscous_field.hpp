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

// With brakes d = (p, s) on the joints the motors make the rest, g = (r + σ, r − σ): joint 1 gets g_1 v̂_2 and joint 2
// g_2 v̂_1, each from an estimate of the other's velocity. Passive, whatever varies, if at all samples i and for j = 1 …
// N
//
//     |g_1(i)| + |g_2(i + j)| ≤ (2/ω)(1 − ε)(h/T_max) d_1(i),     |g_2(i)| + |g_1(i + j)| ≤ 2ω (1 − ε)(h/T_max) d_2(i)
//
// where the estimators, with weights whose sizes sum up to 1, and the loop's delay remember N samples, and ω > 0 is any
// constant. So what one coupling leaves of a sample's allowance is the limit of the other for the next N samples.
// `factor` is (1 − ε) h/T_max.
template <typename S>
Pair<S> gate_allowance(const Pair<S>& brake, double omega, double factor) {
  return {S(2 * factor / omega) * brake[0], S(2 * factor * omega) * brake[1]};
}

// `wanted` is (r + σ, r − σ), `left` what gate_left() gave for each of the last N samples, 0 for those before the
// first. Returns g.
template <typename S>
Pair<S> gated(const Pair<S>& wanted, const Pair<S>& allowance, const std::vector<Pair<S>>& left) {
  using std::max, std::min;
  Pair<S> limit = allowance;
  for (const Pair<S>& one : left) limit = {min(limit[0], one[1]), min(limit[1], one[0])};
  return {max(min(wanted[0], limit[0]), S(-1) * limit[0]), max(min(wanted[1], limit[1]), S(-1) * limit[1])};
}

template <typename S>
Pair<S> gate_left(const Pair<S>& allowance, const Pair<S>& gated) {
  using std::abs;
  return {allowance[0] - abs(gated[0]), allowance[1] - abs(gated[1])};
}

// The ω that is good for a set of poses: ω² halfway between the least and the largest p/s, in logarithms. At one pose
// alone max(|r|, |σ|) ≤ (1 − ε)(h/T_max) √(p s) then passes.
double gate_ratio(const std::vector<JointField<double>>& fields);

}  // namespace dashpot::compiler::axes
