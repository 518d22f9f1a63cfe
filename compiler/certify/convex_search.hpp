// Searches over positive numbers for the minimum of a convex function, and for the boundary of a claim that holds up to
// one place. The answer may be a millionth of the interval's length: `precision` is relative to the answer.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace dashpot::compiler {

inline constexpr int most_search_steps = 150;  // reached only by an answer of 0, to which no relative precision applies

struct ValueAt {
  double place;
  double value;
};

// A level that is of interest, and the function's values at both ends.
struct OfInterest {
  double level, at_low, at_high;
};

// What a convex function is at least between low and high, by the chords through four of its places.
inline double least_by_chords(double low, double at_low, double left, double at_left, double right, double at_right,
                              double high, double at_high) {
  const double middle = (at_right - at_left) / (right - left);
  if (at_left < at_right)
    return std::min(at_left - middle * (left - low),
                    at_left + std::min((at_left - at_low) / (left - low), 0.0) * (right - left));
  return std::min(at_right + middle * (high - right),
                  at_right - std::max((at_high - at_right) / (high - right), 0.0) * (right - left));
}

// Searches for the minimum of a convex function within (low, high) by golden section; stops as soon as a value is at
// most `enough`, or as soon as it is clear that none is at most a level of interest.
template <class Function>
ValueAt golden_section(Function f, double low, double high, double enough, double precision,
                       std::optional<OfInterest> ask = std::nullopt) {
  // The search gives up where the lower bound exceeds the level by this share of what the smaller value exceeds it by:
  // errors of the values are smaller than that.
  constexpr double clearly = 1e-3;
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double left = high - golden * (high - low), right = low + golden * (high - low);
  double at_left = f(left), at_right = f(right);
  for (int i = 0; i < most_search_steps && at_left > enough && at_right > enough; ++i) {
    if (high - low <= precision * high) break;
    if (ask) {
      const double least = least_by_chords(low, ask->at_low, left, at_left, right, at_right, high, ask->at_high);
      if (least - ask->level > clearly * (std::min(at_left, at_right) - ask->level)) break;
    }
    if (at_left < at_right) {
      if (ask) ask->at_high = at_right;
      high = right, right = left, at_right = at_left;
      left = high - golden * (high - low), at_left = f(left);
    } else {
      if (ask) ask->at_low = at_left;
      low = left, left = right, at_left = at_right;
      right = low + golden * (high - low), at_right = f(right);
    }
  }
  return at_left < at_right ? ValueAt{left, at_left} : ValueAt{right, at_right};
}

// The last place towards `fails` where the claim is true, which is true at `holds`.
template <class Claim>
double boundary(Claim claim, double holds, double fails, double precision) {
  for (int i = 0; i < most_search_steps; ++i) {
    const double middle = (holds + fails) / 2;
    if (std::abs(fails - holds) <= precision * std::max(holds, fails)) break;
    if (middle == holds || middle == fails) break;
    (claim(middle) ? holds : fails) = middle;
  }
  return holds;
}

// boundary() of f ≤ level, for a convex function that takes long to evaluate, from two of its values. Chords first find
// two places close to the answer, one on either side. The same bisection then follows, and evaluates f only between
// these two.
template <class Function>
double level_boundary(Function f, double level, ValueAt holds, ValueAt fails, double precision) {
  constexpr double close = 30;  // in multiples of the precision; nearer to the answer rounding decides
  double inside = holds.place, outside = fails.place, below = holds.value - level, above = fails.value - level;
  bool was_inside = false, was_outside = false;
  for (int i = 0; i < most_search_steps; ++i) {
    if (std::abs(outside - inside) <= close * precision * std::max(inside, outside)) break;
    const double middle = (inside + outside) / 2, chord = (inside * above - outside * below) / (above - below);
    const bool is_between = std::min(inside, outside) < chord && chord < std::max(inside, outside);
    const double next = is_between && i % 4 < 3 ? chord : middle;
    if (next == inside || next == outside) break;
    const double there = f(next) - level;
    const bool is_inside = there <= 0;
    if (is_inside) inside = next, below = there;
    else outside = next, above = there;
    if (is_inside && was_inside) above /= 2;  // an end that stays twice counts half, so that it moves (Illinois method)
    if (!is_inside && was_outside) below /= 2;
    was_inside = is_inside, was_outside = !is_inside;
  }
  const double way = holds.place < fails.place ? 1 : -1;
  const auto claim = [&](double x) {
    if (way * x <= way * inside) return true;
    return way * x < way * outside && f(x) <= level;
  };
  return boundary(claim, holds.place, fails.place, precision);
}

}  // namespace dashpot::compiler
