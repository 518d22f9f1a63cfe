// Viscous fields, force = A ẋ over the plane [N·s/m]: which are refused, how they are split between brakes and motors,
// and the gate that keeps the motors' part passive on a sampled loop (theory, section 12).
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "axes/kinematics.hpp"
#include "axes/sloped.hpp"

namespace dashpot::compiler::axes {

template <typename S>
using Matrix = std::array<std::array<S, 2>, 2>;  // by rows

// A(x): the same everywhere, or given at uniform knots and bilinear in each cell between them; beyond the outer knots
// as at the nearest place of their box. Each A is a mean of those at four knots, so that a field takes power everywhere
// if it does at its knots. It need not be differentiable: a damping that jumps in its slope stays a damping.
struct ViscousField {
  Pair<double> start{0, 0};                               // the first knot [m]
  Pair<double> spacing{1, 1};                             // [m]
  std::array<std::size_t, 2> knots{1, 1};                 // in x and in y; both 1: the same everywhere
  std::vector<Matrix<double>> at_knot{Matrix<double>{}};  // rows of equal y, from below [N·s/m]

  bool is_uniform() const { return at_knot.size() == 1; }
  bool is_zero() const;
  bool is_symmetric() const;  // A is symmetric everywhere
};

// Over a cell of the field, one entry of A with s and t the distances from the cell's corner [m]: [0] + [1] s + [2] t +
// [3] s t.
using BilinearCell = std::array<double, 4>;

// A field's cells lie between its knots, rows of equal y from below.
std::array<std::size_t, 2> cells_of(const ViscousField& field);
BilinearCell cell_entry(const ViscousField& field, std::size_t column, std::size_t row, std::size_t i, std::size_t j);

// How far x is from the field's first knot along an axis, but not beyond its outer ones [m].
template <typename S>
S way_from_first_knot(const ViscousField& field, std::size_t axis, const S& x) {
  using std::max, std::min;
  const double length = double(field.knots[axis] - 1) * field.spacing[axis];
  return max(min(x - S(field.start[axis]), S(length)), S(0.0));
}

template <typename S>
S bilinear(const std::array<S, 4>& c, const S& s, const S& t) {
  return c[0] + s * c[1] + t * (c[2] + s * c[3]);
}

Matrix<double> field_at(const ViscousField& field, const Pair<double>& x);
Matrix<Sloped> field_at(const ViscousField& field, const Pair<Sloped>& x);

template <typename S>
Symmetric<S> symmetric_part(const Matrix<S>& a) {
  return {a[0][0], S(0.5) * (a[0][1] + a[1][0]), a[1][1]};
}

// A direction of motion in which a field gives power to the tool.
struct Driving {
  Pair<double> direction;  // of a velocity, of length 1
  double power;            // power given at 1 m/s in that direction [W], positive
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

// Of an A that is known to be symmetric, σ = 0.
template <typename S>
JointField<S> at_joints(const Pose<S>& pose, const Matrix<S>& a, bool is_symmetric) {
  if (is_symmetric) {
    const Symmetric<S> there = at_joints(pose, Symmetric<S>{a[0][0], a[0][1], a[1][1]});
    return {there.xx, there.xy, there.yy, S(0.0)};
  }
  const auto element = [&](std::size_t i, std::size_t j) {
    const Pair<S>& right = pose.column[j];
    return dot(pose.column[i],
               Pair<S>{a[0][0] * right[0] + a[0][1] * right[1], a[1][0] * right[0] + a[1][1] * right[1]});
  };
  const S upper = element(0, 1), lower = element(1, 0);
  return {element(0, 0), S(0.5) * (upper + lower), element(1, 1), S(0.5) * (upper - lower)};
}

template <typename S>
JointField<S> at_joints(const Pose<S>& pose, const ViscousField& field) {
  return at_joints(pose, field_at(field, pose.tip), field.is_symmetric());
}

// With brakes d = (p, s) the motors make what couples them, g = (r + σ, r − σ): brake 1's direction gets g_1 ŷ_2 and
// brake 2's g_2 ŷ_1, each from an estimate of the other's velocity, h ŷ(k) = Σ_j e_j Δy(k + 1 − j), j = 1 …, after n
// samples of delay. Passive, whatever varies, if at all samples i
//
//     γ |g_1(i)| + Σ_j |e_j| |g_2(i + n + j)| ≤ (2/ω)(1 − ε_1)(h/T_max) d_1(i)
//     γ |g_2(i)| + Σ_j |e_j| |g_1(i + n + j)| ≤ 2ω (1 − ε_2)(h/T_max) d_2(i),        γ = Σ_j |e_j|
//
// with any constant ω > 0. What one coupling leaves of its allowance, the right side, becomes the limit of the other,
// and no limit grows by more than `recovery` a sample, for which `reserve` = recovery · Σ |e_j| (n + j − 1) is kept.
struct CurlGate {
  Pair<double> factor{2, 2};  // of d in the allowances
  double gain = 1;            // γ, at least 1
  double reserve = 0;         // [N·m·s/rad]
  double recovery = 0;        // [N·m·s/rad]
};

template <typename S>
struct Gated {
  Pair<S> coupling;  // g
  Pair<S> left;      // by g_1, the limit of g_2 at the next sample, and by g_2 that of g_1
};

// `left` as it came of the sample before, 0 before the first. Where both couplings are wanted in full, neither gets so
// much that nothing is left for the other: r and σ are limited alike.
template <typename S>
Gated<S> gated(const CurlGate& gate, const Pair<S>& brake, const S& r, const S& sigma, const Pair<S>& left) {
  using std::abs, std::max, std::min;
  const auto clamped = [](const S& x, const S& limit) { return max(min(x, limit), -limit); };
  const auto allowance = [&](std::size_t j) { return max(S(gate.factor[j]) * brake[j] - S(gate.reserve), S(0)); };
  const Pair<S> allowed{allowance(0), allowance(1)};
  const S most = S(0.5 / gate.gain) * min(allowed[0], allowed[1]);
  const S mixed = clamped(r, most), turning = clamped(sigma, most);
  const Pair<S> g{clamped(mixed + turning, left[1]), clamped(mixed - turning, left[0])};
  const auto left_by = [&](std::size_t j) {
    return min(S(1 / gate.gain) * allowed[j] - abs(g[j]), left[j] + S(gate.recovery));
  };
  return {g, {left_by(0), left_by(1)}};
}

// The ω that is good for a set of p and s, those of poses: ω² halfway between the least and the largest p/s, in
// logarithms. At one pose alone max(|r|, |σ|) ≤ (1 − ε)(h/T_max) √(p s) then passes. 1 where no pose has p > 0 and s >
// 0.
double gate_ratio(const std::vector<Pair<double>>& dampings);

}  // namespace dashpot::compiler::axes
