// How much rounding changes a mode's force, and the form of the update that keeps this within bounds.
#pragma once

#include "law/update_law.hpp"

namespace dashpot::compiler {

double unit_roundoff(ScalarType scalar);
double largest_finite(ScalarType scalar);

// Worst case over any run, relative to the mode's largest force, for a decay of `loss` = 1 − a a sample.
double error_bound(ModeForm form, double loss, double roundoff);

// The cheapest form whose bound is tolerable: 1e-12 in double, 1e-3 in float.
ModeForm cheapest_form(double smallest_loss, ScalarType scalar);

// Magnitudes below are set to zero: small enough never to be felt, large enough that products of two kept numbers stay
// normal [N].
double flush_threshold(ScalarType scalar);

// The number of samples for which a force that is multiplied by `decay` in each can go without a guard: from the
// threshold it may fall to 2^-400 in double, whose square is still normal. 0 in float, where the threshold's own square
// is the last that is.
std::size_t samples_without_guard(double decay, ScalarType scalar);

// Constants below are set to zero: their product with a kept force would be subnormal, and nothing would be left of it.
double smallest_constant(ScalarType scalar);

}  // namespace dashpot::compiler
