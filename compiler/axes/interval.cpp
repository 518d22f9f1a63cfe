#include "axes/interval.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace dashpot::compiler::axes {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int library_steps = 4;

// An enclosure of values that the C library has computed.
Interval of_library(double low, double high, double least, double most) {
  for (int i = 0; i < library_steps; ++i) low = below(low), high = above(high);
  return {std::max(low, least), std::min(high, most)};
}

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

Interval product_beyond_numbers(const Interval& a, const Interval& b) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Interval all(infinity, -infinity);
  for (const double x : {a.low, a.high}) {
    for (const double y : {b.low, b.high}) {
      const bool zero = x == 0 || y == 0;
      all = hull(all, zero ? Interval(0) : Interval(below(x * y), above(x * y)));
    }
  }
  return all;
}

Interval operator/(const Interval& a, const Interval& b) {
  if (b.holds(0)) return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  return a * Interval{below(1 / b.high), above(1 / b.low)};
}

Interval fraction(const Interval& part, const Interval& reciprocal) {
  const Interval product = part * reciprocal;
  return {std::clamp(product.low, -1.0, 1.0), std::clamp(product.high, -1.0, 1.0)};
}

Interval sqrt(const Interval& a) {
  if (a.high <= 0) return {0, 0};
  return {a.low <= 0 ? 0 : below(std::sqrt(a.low)), above(std::sqrt(a.high))};
}

Interval sin(const Interval& a) { return wave(a, std::sin(a.low), std::sin(a.high), pi / 2, -pi / 2); }
Interval cos(const Interval& a) { return wave(a, std::cos(a.low), std::cos(a.high), 0, pi); }
Interval atan(const Interval& a) { return of_library(std::atan(a.low), std::atan(a.high), -2, 2); }

Interval acos(const Interval& a) {
  return of_library(std::acos(std::clamp(a.high, -1.0, 1.0)), std::acos(std::clamp(a.low, -1.0, 1.0)), 0, 4);
}

Interval widened(const Interval& a, double amount) { return {below(a.low - amount), above(a.high + amount)}; }

}  // namespace dashpot::compiler::axes
