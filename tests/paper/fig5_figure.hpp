// The paper's Fig. 5: the 2nd-order Maxwell solid through a ramp and a hold in steps of 200 ms, in the paper's four
// panels.
#pragma once

#include <vector>

#include "figure.hpp"
#include "response.hpp"

namespace dashpot::paper::fig5 {

// The paper prints no rate of its ramp: 10 mm/s, for the reason that chosen.json gives under "fig5.rate".
inline constexpr RampAndHold insertion{10e-3, 4};
inline constexpr double end = 8;  // [s]

// B1, K1 and B2, K2 of Fig. 5, and K3.
inline const MaxwellSolid solid{{{5, 12}, {6, 10}}, 5};

// Of backward Euler in steps of 200 ms, from (13) and (15) by hand: relative to the peak, and when.
inline constexpr double euler_error = 0.02200, euler_error_digits = 0.00001;
inline constexpr double euler_error_time = 0.6;  // [s]

// The emitted law by both schemes; `damping` is what it gives to the brake [N·s/m].
Figure figure(const std::vector<ResponseSample>& exact, const std::vector<ResponseSample>& euler, double damping);

}  // namespace dashpot::paper::fig5
