// A springpot, c s^α with 0 < α < 1, as Maxwell elements in parallel, with a guaranteed error over a band of
// frequencies.
#pragma once

#include <cstddef>
#include <vector>

namespace dashpot::compiler {

struct MaxwellBranch {
  double stiffness;        // [N/m] or [N·m/rad]; of a ladder for c = 1: [1/s^α]
  double relaxation_rate;  // [1/s]
};

struct SpringpotLadder {
  std::vector<MaxwellBranch> branches;  // slow to fast
  double error = 0;                     // bound on |ladder − (jω)^α|/ω^α over the band
};

// Points of the trapezoid rule in x = ln λ, at first, first + step, …; what lies below and above is lumped.
struct SpringpotGrid {
  double first;
  double step;
  std::size_t points;
};

// c s^α = c (sin πα/π) ∫ e^{αx} s/(s + e^x) dx. By the trapezoid rule it is Σ k_i s/(s + λ_i), with
// k_i = c (sin πα/π) η λ_i^α, η the step: Maxwell elements of positive stiffness. The two tails of the endless sum are
// geometric series; each becomes one element of the same first two moments: Σk and Σkλ below, Σk/λ and Σk/λ² above.
// No spring and no damper of its own is left, so that the ladder relaxes to zero as a springpot does.
//
// In: 0 < exponent < 1, 0 < low < high [rad/s]. Out: the elements for c = 1 and the sum of three bounds, where
// C = η sin πα/π:
//   ripple of the trapezoid rule (Poisson's sum)   Σ_m 2 sin πα cosh(π²m/η)/√(sin² πα + sinh²(2π²m/η))
//   tail below    (Σ kλ² − (Σkλ)²/Σk) / low^(2+α)
//   tail above    (Σ k/λ³ − (Σk/λ²)²/Σ(k/λ)) · high^(3−α)
// The tails by Taylor's theorem about the mean of λ, or of 1/λ: the linear terms vanish, and the second derivatives of
// s/(s + λ) are at most 2/ω² and, per k/λ, 2ω³.
SpringpotLadder springpot_ladder(double exponent, double low, double high, const SpringpotGrid& grid);

// The ladder of fewest elements, two of them for the tails, whose error is at most `error`.
SpringpotLadder springpot_ladder(double exponent, double low, double high, double error);

}  // namespace dashpot::compiler
