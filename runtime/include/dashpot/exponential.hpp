// What a relaxation loses over a sample, without <cmath>: additions, products and one division in a stated order, so
// that every IEEE target gives the same bits under -ffp-contract=off. constexpr, no heap, no loop that depends on data.
#pragma once

#include <dashpot/elementary.hpp>

namespace dashpot {

// φ(x) = (1 − e^(−x))/x = −expm1(−x)/x for x ≥ 0, with φ(0) = 1 and φ(∞) = 0: how much of a displacement that grows
// evenly over a sample is left in a Maxwell element at its end, x being the sample over the relaxation time. A negative
// x counts as 0, and NaN stays NaN. Relative error at most 3 units of roundoff (2⁻⁵³ in double, 2⁻²⁴ in float) wherever
// the result is a normal number.
template <class Scalar>
constexpr Scalar mean_decay(Scalar x) noexcept {
  if (x <= 0) return 1;
  if (x >= Scalar(0.6875)) return (1 - decay(x)) / x;
  // φ = 1 − x/2 (1 − x/3 (1 − x/4 (…))) to x¹⁶/17!, below a tenth of the last place for x ≤ 11/16.
  Scalar sum = 1;
  for (int n = 17; n > 1; --n) sum = 1 - x * detail::reciprocal_of<Scalar>[n] * sum;
  return sum;
}

}  // namespace dashpot
