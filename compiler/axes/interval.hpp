// Enclosures: every operation returns an interval that holds each result that its operands' members have. Ends are
// rounded to nearest and then moved outward by one or two steps of double precision for + − * / √, which are exact to
// half of one, and by four for sin, cos, atan, acos, of which the C library's are within one. So no mode of rounding is
// set, and what the compiler makes of the text cannot undo it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace dashpot::compiler::axes {

struct Interval {
  double low = 0, high = 0;

  Interval() = default;
  explicit Interval(double value) : low(value), high(value) {}
  Interval(double low_end, double high_end) : low(low_end), high(high_end) {}

  double middle() const { return low + 0.5 * (high - low); }
  double width() const { return high - low; }
  bool holds(double value) const { return low <= value && value <= high; }
};

// A step below and above: 2⁻⁵² |x| is one or two units in the last place of x, and the smallest normal number is enough
// for subnormal ones. The step below infinity begins at the largest number.
inline double below(double x) {
  constexpr double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::min();
  const double finite = std::min(x, largest);
  return finite - (std::numeric_limits<double>::epsilon() * std::abs(finite) + least);
}
inline double above(double x) { return -below(-x); }

inline bool is_zero(const Interval& a) { return a.low == 0 && a.high == 0; }

inline Interval operator-(const Interval& a) { return {-a.high, -a.low}; }

// A sum with 0 is exact.
inline Interval operator+(const Interval& a, const Interval& b) {
  const auto exact = [](double x, double y) { return x == 0 || y == 0; };
  const double low = a.low + b.low, high = a.high + b.high;
  return {exact(a.low, b.low) ? low : below(low), exact(a.high, b.high) ? high : above(high)};
}
inline Interval operator-(const Interval& a, const Interval& b) { return a + -b; }

// For operands with an infinite end: infinity times 0 is 0.
Interval product_beyond_numbers(const Interval& a, const Interval& b);

// By a factor that is nowhere negative: no sign changes, and so each end is one product.
inline Interval scaled_up(const Interval& factor, const Interval& a) {
  const double low = below(a.low * (a.low >= 0 ? factor.low : factor.high));
  const double high = above(a.high * (a.high >= 0 ? factor.high : factor.low));
  return {a.low >= 0 ? std::max(low, 0.0) : low, a.high <= 0 ? std::min(high, 0.0) : high};
}

// A product of two that do not change their sign does not either, and one with 0 is 0.
inline Interval operator*(const Interval& a, const Interval& b) {
  if (is_zero(a) || is_zero(b)) return Interval(0);
  if (!((a.high - a.low) + (b.high - b.low) < std::numeric_limits<double>::infinity()))
    return product_beyond_numbers(a, b);
  if (a.low >= 0) return scaled_up(a, b);
  if (a.high <= 0) return -scaled_up(-a, b);
  if (b.low >= 0) return scaled_up(b, a);
  if (b.high <= 0) return -scaled_up(-b, a);
  return {below(std::min(a.low * b.high, a.high * b.low)), above(std::max(a.low * b.low, a.high * b.high))};
}

// All numbers where the divisor holds 0.
Interval operator/(const Interval& a, const Interval& b);

inline Interval abs(const Interval& a) {
  if (a.low >= 0) return a;
  if (a.high <= 0) return -a;
  return {0, std::max(-a.low, a.high)};
}
inline Interval square(const Interval& a) {
  const Interval size = abs(a);
  return {std::max(below(size.low * size.low), 0.0), size.high == 0 ? 0 : above(size.high * size.high)};
}
// part/whole, by the reciprocal of the whole, where |part| ≤ whole.
Interval fraction(const Interval& part, const Interval& reciprocal);
// The root of the part of an interval that is not negative; [0, 0] if there is none.
Interval sqrt(const Interval& a);
inline Interval min(const Interval& a, const Interval& b) { return {std::min(a.low, b.low), std::min(a.high, b.high)}; }
inline Interval max(const Interval& a, const Interval& b) { return {std::max(a.low, b.low), std::max(a.high, b.high)}; }
// Arguments up to 1000 rad; [−1, 1] beyond.
Interval sin(const Interval& a);
Interval cos(const Interval& a);
Interval atan(const Interval& a);
// For the part of an interval that lies in [−1, 1].
Interval acos(const Interval& a);

// The smallest interval that holds both.
inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}
// By an amount at either end.
Interval widened(const Interval& a, double amount);

}  // namespace dashpot::compiler::axes
