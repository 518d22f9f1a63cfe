#include "axes/interval.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace dashpot::compiler::axes {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;
constexpr int library_steps = 4;

double below(double x) { return std::nextafter(x, -infinity); }
double above(double x) { return std::nextafter(x, infinity); }

// Of values that the C library has computed.
Interval of_library(double low, double high, double least, double most) {
  for (int i = 0; i < library_steps; ++i) low = below(low), high = above(high);
  return {std::max(low, least), std::min(high, most)};
}

// A product with 0 is 0 and exact, also with an infinite end.
struct Products {
  double low = infinity, high = -infinity;

  void add(double a, double b) {
    const bool zero = a == 0 || b == 0;
    low = std::min(low, zero ? 0 : below(a * b));
    high = std::max(high, zero ? 0 : above(a * b));
  }
};

// Whether a whole number of turns from `phase` lies in an interval, or so close that sin and cos cannot tell.
bool meets(const Interval& a, double phase) {
  constexpr double close = 1e-9;  // [rad]: 1 − cos is then half of 1e-18
  const double last = phase + 2 * pi * std::floor((a.high + close - phase) / (2 * pi));
  return last >= a.low - close;
}

// sin or cos, of which `top` and `bottom` are the phases of the largest and the smallest value.
Interval wave(const Interval& a, double at_low, double at_high, double top, double bottom) {
  constexpr double largest_argument = 1000;
  if (!(std::max(std::abs(a.low), std::abs(a.high)) <= largest_argument)) return {-1, 1};
  const Interval ends = of_library(std::min(at_low, at_high), std::max(at_low, at_high), -1, 1);
  return {meets(a, bottom) ? -1 : ends.low, meets(a, top) ? 1 : ends.high};
}

}  // namespace

Interval operator-(const Interval& a) { return {-a.high, -a.low}; }
Interval operator+(const Interval& a, const Interval& b) {
  const auto exact = [](double x, double y) { return x == 0 || y == 0; };
  const double low = a.low + b.low, high = a.high + b.high;
  return {exact(a.low, b.low) ? low : below(low), exact(a.high, b.high) ? high : above(high)};
}
Interval operator-(const Interval& a, const Interval& b) { return a + -b; }

Interval operator*(const Interval& a, const Interval& b) {
  Products all;
  for (const double x : {a.low, a.high}) {
    for (const double y : {b.low, b.high}) all.add(x, y);
  }
  return {all.low, all.high};
}

Interval operator/(const Interval& a, const Interval& b) {
  if (b.holds(0)) return {-infinity, infinity};
  return a * Interval{below(1 / b.high), above(1 / b.low)};
}

Interval fraction(const Interval& part, const Interval& reciprocal) {
  const Interval product = part * reciprocal;
  return {std::clamp(product.low, -1.0, 1.0), std::clamp(product.high, -1.0, 1.0)};
}

Interval square(const Interval& a) {
  const Interval size = abs(a);
  const auto end = [](double x, double rounded) { return x == 0 ? 0 : rounded; };
  return {end(size.low, std::max(below(size.low * size.low), 0.0)), end(size.high, above(size.high * size.high))};
}

Interval sqrt(const Interval& a) {
  if (a.high <= 0) return {0, 0};
  return {a.low <= 0 ? 0 : below(std::sqrt(a.low)), above(std::sqrt(a.high))};
}

Interval abs(const Interval& a) {
  if (a.low >= 0) return a;
  if (a.high <= 0) return -a;
  return {0, std::max(-a.low, a.high)};
}

Interval min(const Interval& a, const Interval& b) { return {std::min(a.low, b.low), std::min(a.high, b.high)}; }
Interval max(const Interval& a, const Interval& b) { return {std::max(a.low, b.low), std::max(a.high, b.high)}; }
Interval sin(const Interval& a) { return wave(a, std::sin(a.low), std::sin(a.high), pi / 2, -pi / 2); }
Interval cos(const Interval& a) { return wave(a, std::cos(a.low), std::cos(a.high), 0, pi); }
Interval atan(const Interval& a) { return of_library(std::atan(a.low), std::atan(a.high), -2, 2); }

Interval acos(const Interval& a) {
  return of_library(std::acos(std::clamp(a.high, -1.0, 1.0)), std::acos(std::clamp(a.low, -1.0, 1.0)), 0, 4);
}

Interval hull(const Interval& a, const Interval& b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }
Interval widened(const Interval& a, double amount) { return {below(a.low - amount), above(a.high + amount)}; }

}  // namespace dashpot::compiler::axes
