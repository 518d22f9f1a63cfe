// Enclosures that shrink with the square of a box: a value with its derivatives, each enclosed over the box, and its
// value in the middle,
//
//     f(x) ∈ f(middle) + Σ_j ∂f/∂t_j(box) t_j,        x_j = middle_j + radius_j t_j,        |t_j| ≤ 1
//
// which every operation intersects with the enclosure of f itself (Moore, Kearfott & Cloud 2009, 6.4). For what is
// written once for every scalar. The first two t_j are of the coordinates of a box, the others of how far joints go
// from there.
#pragma once

#include <limits>

#include "axes/interval.hpp"
#include "axes/pair.hpp"

namespace dashpot::compiler::axes {

using Box = Pair<Interval>;  // of tip positions [m], or of joint positions [rad]

inline Pair<double> middle_of(const Box& box) { return {box[0].middle(), box[1].middle()}; }

using Slopes = std::array<Interval, 4>;  // ∂/∂t_j

struct Sloped {
  Interval value, middle;
  Slopes slope{};

  explicit Sloped(double constant) : value(constant), middle(constant) {}
  explicit Sloped(const Interval& constant) : value(constant), middle(constant) {}
  Sloped(const Interval& value_over, const Interval& in_middle, const Slopes& slope_over)
      : value(value_over), middle(in_middle), slope(slope_over) {
    double most = 0;
    for (const Interval& one : slope)
      if (!is_zero(one)) most = above(most + abs(one).high);
    const Interval near = middle + Interval(-most, most);
    if (near.low > value.low) value.low = near.low;
    if (near.high < value.high) value.high = near.high;
  }
};

// The j-th coordinate of a box.
inline Sloped variable(const Interval& over, std::size_t j) {
  const Interval middle(over.middle()), apart = over - middle;
  Sloped result(over, middle, {});
  result.value = over;
  result.slope[j] = Interval(std::max(-apart.low, apart.high));
  return result;
}

inline Pair<Sloped> variables(const Box& box) { return {variable(box[0], 0), variable(box[1], 1)}; }

// first·a + second·b of the derivatives of two.
inline Slopes combined(const Interval& first, const Slopes& a, const Interval& second, const Slopes& b) {
  Slopes result;
  for (std::size_t j = 0; j < result.size(); ++j) result[j] = first * a[j] + second * b[j];
  return result;
}

inline Slopes scaled(const Interval& by, const Slopes& a) {
  Slopes result;
  for (std::size_t j = 0; j < result.size(); ++j) result[j] = by * a[j];
  return result;
}

// A function with its enclosure of an interval, of which the derivative is enclosed over a.value.
template <typename Function>
Sloped chained(const Function& f, const Interval& derivative, const Sloped& a) {
  return {f(a.value), f(a.middle), scaled(derivative, a.slope)};
}

inline Sloped operator-(const Sloped& a) {
  Sloped result = a;
  result.value = -a.value, result.middle = -a.middle;
  for (Interval& one : result.slope) one = -one;
  return result;
}
inline Sloped operator+(const Sloped& a, const Sloped& b) {
  Slopes sum;
  for (std::size_t j = 0; j < sum.size(); ++j) sum[j] = a.slope[j] + b.slope[j];
  return {a.value + b.value, a.middle + b.middle, sum};
}
inline Sloped operator-(const Sloped& a, const Sloped& b) { return a + -b; }
inline Sloped operator*(const Sloped& a, const Sloped& b) {
  return {a.value * b.value, a.middle * b.middle, combined(b.value, a.slope, a.value, b.slope)};
}
inline Sloped operator/(const Sloped& a, const Sloped& b) {
  const Interval quotient = a.value / b.value, inverse = Interval(1) / b.value;
  return {quotient, a.middle / b.middle, combined(inverse, a.slope, -(inverse * quotient), b.slope)};
}
inline Sloped square(const Sloped& a) {
  return chained([](const Interval& x) { return square(x); }, Interval(2) * a.value, a);
}
inline Sloped fraction(const Sloped& part, const Sloped& reciprocal) {
  return {fraction(part.value, reciprocal.value), fraction(part.middle, reciprocal.middle), (part * reciprocal).slope};
}
inline Sloped atan(const Sloped& a) {
  return chained([](const Interval& x) { return atan(x); }, Interval(1) / (Interval(1) + square(a.value)), a);
}
inline Sloped acos(const Sloped& a) {
  return chained([](const Interval& x) { return acos(x); }, Interval(-1) / sqrt(Interval(1) - square(a.value)), a);
}
inline Sloped sqrt(const Sloped& a) {
  return chained([](const Interval& x) { return sqrt(x); }, Interval(0.5) / sqrt(a.value), a);
}
inline Sloped sin(const Sloped& a) {
  return chained([](const Interval& x) { return sin(x); }, cos(a.value), a);
}
inline Sloped cos(const Sloped& a) {
  return chained([](const Interval& x) { return cos(x); }, -sin(a.value), a);
}

// If either may be the larger one, the slopes enclose those of both.
inline Sloped max(const Sloped& a, const Sloped& b) {
  if (a.value.low >= b.value.high) return a;
  if (b.value.low >= a.value.high) return b;
  Slopes either;
  for (std::size_t j = 0; j < either.size(); ++j) either[j] = hull(a.slope[j], b.slope[j]);
  return {max(a.value, b.value), max(a.middle, b.middle), either};
}
inline Sloped min(const Sloped& a, const Sloped& b) { return -max(-a, -b); }
inline Sloped abs(const Sloped& a) { return max(a, -a); }

}  // namespace dashpot::compiler::axes
