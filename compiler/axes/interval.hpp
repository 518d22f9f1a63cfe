// Enclosures: every operation returns an interval that holds each result that its operands' members have. Ends are
// rounded to nearest and then moved outward by one step of double precision for + − * / √, which are exact to half of
// one, and by four for sin, cos, atan, acos, of which the C library's are within one. So no mode of rounding is set,
// and what the compiler makes of the text cannot undo it.
#pragma once

#include <cmath>

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

Interval operator-(const Interval& a);
Interval operator+(const Interval& a, const Interval& b);
Interval operator-(const Interval& a, const Interval& b);
Interval operator*(const Interval& a, const Interval& b);
// All numbers where the divisor holds 0.
Interval operator/(const Interval& a, const Interval& b);

Interval square(const Interval& a);
Interval fraction(const Interval& part, const Interval& reciprocal);
// Of what of it is not negative; [0, 0] where nothing is.
Interval sqrt(const Interval& a);
Interval abs(const Interval& a);
Interval min(const Interval& a, const Interval& b);
Interval max(const Interval& a, const Interval& b);
// Arguments up to 1000 rad; [−1, 1] beyond.
Interval sin(const Interval& a);
Interval cos(const Interval& a);
Interval atan(const Interval& a);
// Of what of it lies in [−1, 1].
Interval acos(const Interval& a);

// The smallest interval that holds both.
Interval hull(const Interval& a, const Interval& b);
// By an amount at either end.
Interval widened(const Interval& a, double amount);

}  // namespace dashpot::compiler::axes
