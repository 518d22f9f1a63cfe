// Vectors and symmetric matrices of two axes, over any scalar: double, an enclosure (interval.hpp), or one that records
// what is done to it. A scalar is made of a double, and has + − * / and, found by argument, sin, cos, sqrt, abs, min,
// max.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace dashpot::compiler::axes {

template <typename S>
using Pair = std::array<S, 2>;

// [[xx, xy], [xy, yy]].
template <typename S>
struct Symmetric {
  S xx, xy, yy;
};

// A scalar for which x·x is not the tightest square has one of its own.
template <typename S>
S square(const S& x) {
  return x * x;
}

// `yes` where `condition` is above zero, else `no`.
inline double where(double condition, double yes, double no) { return condition > 0 ? yes : no; }

// part/whole, by the reciprocal of the whole, where |part| ≤ whole: an enclosure of it stays within −1 … 1.
template <typename S>
S fraction(const S& part, const S& reciprocal) {
  return part * reciprocal;
}

template <typename S>
Pair<S> operator+(const Pair<S>& a, const Pair<S>& b) {
  return {a[0] + b[0], a[1] + b[1]};
}

template <typename S>
Pair<S> operator-(const Pair<S>& a, const Pair<S>& b) {
  return {a[0] - b[0], a[1] - b[1]};
}

template <typename S>
Pair<S> operator*(const S& factor, const Pair<S>& a) {
  return {factor * a[0], factor * a[1]};
}

template <typename S>
S dot(const Pair<S>& a, const Pair<S>& b) {
  return a[0] * b[0] + a[1] * b[1];
}

template <typename S>
S length_squared(const Pair<S>& a) {
  return square(a[0]) + square(a[1]);
}

// A quarter of a turn, counterclockwise.
template <typename S>
Pair<S> turned(const Pair<S>& a) {
  return {-a[1], a[0]};
}

template <typename S>
Pair<S> constant(const Pair<double>& a) {
  return {S(a[0]), S(a[1])};
}

template <typename S>
Symmetric<S> operator+(const Symmetric<S>& a, const Symmetric<S>& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
}

template <typename S>
Symmetric<S> operator-(const Symmetric<S>& a, const Symmetric<S>& b) {
  return {a.xx - b.xx, a.xy - b.xy, a.yy - b.yy};
}

template <typename S>
Symmetric<S> operator*(const S& factor, const Symmetric<S>& a) {
  return {factor * a.xx, factor * a.xy, factor * a.yy};
}

// a aᵀ.
template <typename S>
Symmetric<S> outer(const Pair<S>& a) {
  return {square(a[0]), a[0] * a[1], square(a[1])};
}

// aᵀ m b.
template <typename S>
S form(const Pair<S>& a, const Symmetric<S>& m, const Pair<S>& b) {
  return a[0] * (m.xx * b[0] + m.xy * b[1]) + a[1] * (m.xy * b[0] + m.yy * b[1]);
}

}  // namespace dashpot::compiler::axes
