// Searches along a line, for functions that are convex there and claims that hold up to one place.
#pragma once

#include <cmath>

namespace dashpot::compiler {

struct LeastPlace {
  double place;
  double value;
};

// Towards the least of a convex function within (low, high), by golden section; left as soon as a value is at most
// `enough`.
template <class Function>
LeastPlace golden_section(Function f, double low, double high, double enough, int steps) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double left = high - golden * (high - low), right = low + golden * (high - low);
  double at_left = f(left), at_right = f(right);
  for (int i = 0; i < steps && at_left > enough && at_right > enough; ++i) {
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
double boundary(Claim claim, double holds, double fails, int steps) {
  for (int i = 0; i < steps; ++i) {
    const double middle = (holds + fails) / 2;
    if (middle == holds || middle == fails) break;
    (claim(middle) ? holds : fails) = middle;
  }
  return holds;
}

}  // namespace dashpot::compiler
