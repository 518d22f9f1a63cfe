// Enclosures that shrink with the square of a box: a value with its derivatives by what it depends on, each enclosed,
// and so
//
//     f(x) ∈ f(middle) + Σ_j ∂f/∂x_j(box) (x_j − middle_j)
//
// beside the enclosure of f itself (Moore, Kearfott & Cloud 2009, 6.4). For what is written once for every scalar. The
// first two x_j are the coordinates of a box, the others how far joints go from there.
#pragma once

#include <limits>

#include "axes/interval.hpp"
#include "axes/pair.hpp"

namespace dashpot::compiler::axes {

using Box = Pair<Interval>;  // of tip positions [m], or of joint positions [rad]

inline Pair<double> middle_of(const Box& box) { return {box[0].middle(), box[1].middle()}; }

using Slopes = std::array<Interval, 4>;  // one for each x_j, or x_j − middle_j

struct Sloped {
  Interval value;
  Slopes slope{};

  explicit Sloped(double constant) : value(constant) {}
  explicit Sloped(const Interval& constant) : value(constant) {}
  Sloped(const Interval& value_over, const Slopes& slope_over) : value(value_over), slope(slope_over) {}
};

// first·a + second·b of the derivatives of two.
inline Slopes combined(const Interval& first, const Slopes& a, const Interval& second, const Slopes& b) {
  Slopes result;
  for (std::size_t j = 0; j < result.size(); ++j) result[j] = first * a[j] + second * b[j];
  return result;
}

// Of a function whose derivative is enclosed too.
inline Sloped chained(const Interval& value, const Interval& derivative, const Sloped& a) {
  return {value, combined(derivative, a.slope, Interval(0), a.slope)};
}

inline Sloped operator-(const Sloped& a) { return chained(-a.value, Interval(-1), a); }
inline Sloped operator+(const Sloped& a, const Sloped& b) {
  return {a.value + b.value, combined(Interval(1), a.slope, Interval(1), b.slope)};
}
inline Sloped operator-(const Sloped& a, const Sloped& b) {
  return {a.value - b.value, combined(Interval(1), a.slope, Interval(-1), b.slope)};
}
inline Sloped operator*(const Sloped& a, const Sloped& b) {
  return {a.value * b.value, combined(b.value, a.slope, a.value, b.slope)};
}
inline Sloped operator/(const Sloped& a, const Sloped& b) {
  const Interval quotient = a.value / b.value, inverse = Interval(1) / b.value;
  return {quotient, combined(inverse, a.slope, -(inverse * quotient), b.slope)};
}
inline Sloped square(const Sloped& a) { return chained(square(a.value), Interval(2) * a.value, a); }
inline Sloped fraction(const Sloped& part, const Sloped& reciprocal) {
  return {fraction(part.value, reciprocal.value), (part * reciprocal).slope};
}
inline Sloped atan(const Sloped& a) { return chained(atan(a.value), Interval(1) / (Interval(1) + square(a.value)), a); }
inline Sloped acos(const Sloped& a) {
  return chained(acos(a.value), Interval(-1) / sqrt(Interval(1) - square(a.value)), a);
}
inline Sloped sqrt(const Sloped& a) {
  const Interval root = sqrt(a.value);
  return chained(root, Interval(0.5) / root, a);
}
inline Sloped sin(const Sloped& a) { return chained(sin(a.value), cos(a.value), a); }
inline Sloped cos(const Sloped& a) { return chained(cos(a.value), -sin(a.value), a); }

// Where it is open which of both it is, the derivative is that of either.
inline Sloped max(const Sloped& a, const Sloped& b) {
  if (a.value.low >= b.value.high) return a;
  if (b.value.low >= a.value.high) return b;
  Slopes either;
  for (std::size_t j = 0; j < either.size(); ++j) either[j] = hull(a.slope[j], b.slope[j]);
  return {max(a.value, b.value), either};
}
inline Sloped min(const Sloped& a, const Sloped& b) { return -max(-a, -b); }
inline Sloped abs(const Sloped& a) { return max(a, -a); }

// From the function's values with slopes and from its value in the middle, `apart` from there by at most so much.
inline Interval centred(const Sloped& over, const Interval& in_middle, const Slopes& apart) {
  Interval near = in_middle;
  for (std::size_t j = 0; j < apart.size(); ++j) near = near + over.slope[j] * apart[j];
  return {std::max(over.value.low, near.low), std::min(over.value.high, near.high)};
}

inline Symmetric<Interval> centred(const Symmetric<Sloped>& over, const Symmetric<Interval>& in_middle,
                                   const Slopes& apart) {
  return {centred(over.xx, in_middle.xx, apart), centred(over.xy, in_middle.xy, apart),
          centred(over.yy, in_middle.yy, apart)};
}

inline Pair<Sloped> variables(const Box& box) {
  return {Sloped(box[0], {Interval(1)}), Sloped(box[1], {Interval(0), Interval(1)})};
}

inline Slopes apart_in(const Box& box) {
  const Pair<double> middle = middle_of(box);
  return {box[0] - Interval(middle[0]), box[1] - Interval(middle[1])};
}

// Of a function that takes joints of either scalar to a matrix of it.
template <typename Function>
Symmetric<Interval> enclosed(const Box& box, const Function& f) {
  return centred(f(variables(box)), f(constant<Interval>(middle_of(box))), apart_in(box));
}

}  // namespace dashpot::compiler::axes
