// What a linear network answers to a displacement that is linear between samples, by inverting its Laplace transform:
// no modes, no matrices, no recursion, nothing of the compiler's own stages.
#pragma once

#include <vector>

#include "support/exact_oracle.hpp"

namespace dashpot::testing {

// R(kT), k = 1…count: the force kT [s] after the tool began to move at 1 m/s, as
//
//     R(t) = 1/(2πi) ∫ e^{st} D(s)/s² ds
//
// along a hyperbola around the negative half axis, where all singularities of a spring–damper network are; the
// trapezium rule there converges geometrically, at one contour for all of the times (Weideman & Trefethen 2007). 20
// digits.
std::vector<Exact> ramp_response(const compiler::Network& network, double period, std::size_t count);

// The force in front of each sample, the displacement being 0 until the first period begins and linear in each; as many
// positions [m] as the ramp response has values. With the velocity of the period that ends, this is the network's
// force.
std::vector<double> force_by_ramps(const std::vector<Exact>& ramp, const std::vector<double>& positions, double period);

}  // namespace dashpot::testing
