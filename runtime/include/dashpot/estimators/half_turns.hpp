// Sine and tangent of an angle given in half turns, without <cmath>: constexpr, so that a filter designed from
// constants costs a firmware nothing, and the same bits everywhere.
#pragma once

namespace dashpot {

inline constexpr double pi = 3.14159265358979323846;

namespace detail {

// Σ (−1)^i x^(first+2i) / (first+2i)!: the sine for first = 1, the cosine for first = 0. For |x| ≤ π/4 the ten terms
// leave less than 1e-20.
constexpr double alternating_series(double x, int first) noexcept {
  double term = first == 0 ? 1.0 : x;
  double sum = term;
  for (int n = first + 2; n < first + 20; n += 2) {
    term *= -x * x / (n * (n - 1));
    sum += term;
  }
  return sum;
}

}  // namespace detail

// sin(π·half_turns) for 0 ≤ half_turns ≤ ½, to a few units in the last place.
constexpr double sine_of_half_turns(double half_turns) noexcept {
  return half_turns <= 0.25 ? detail::alternating_series(pi * half_turns, 1)
                            : detail::alternating_series(pi * (0.5 - half_turns), 0);
}

// tan(π·half_turns) for 0 ≤ half_turns < ½, to a few units in the last place.
constexpr double tangent_of_half_turns(double half_turns) noexcept {
  return sine_of_half_turns(half_turns) / sine_of_half_turns(0.5 - half_turns);
}

}  // namespace dashpot
