// Searches over positive numbers for the minimum of a convex function, and for the boundary of a claim that holds up to
// one place. The answer may be a millionth of the interval's length: `precision` is relative to the answer.
#pragma once

#include <algorithm>
#include <cmath>

namespace dashpot::compiler {

inline constexpr int most_search_steps = 150;  // reached only by an answer of 0, to which no relative precision applies

struct LeastPlace {
  double place;
  double value;
};

// Searches for the minimum of a convex function within (low, high) by golden section; stops as soon as a value is at
// most `enough`.
template <class Function>
LeastPlace golden_section(Function f, double low, double high, double enough, double precision) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double left = high - golden * (high - low), right = low + golden * (high - low);
  double at_left = f(left), at_right = f(right);
  for (int i = 0; i < most_search_steps && at_left > enough && at_right > enough; ++i) {
    if (high - low <= precision * high) break;
    if (at_left < at_right) {
      high = right, right = left, at_right = at_left;
      left = high - golden * (high - low), at_left = f(left);
    } else {
      low = left, left = right, at_left = at_right;
      right = low + golden * (high - low), at_right = f(right);
    }
  }
  return at_left < at_right ? LeastPlace{left, at_left} : LeastPlace{right, at_right};
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

}  // namespace dashpot::compiler
