// What the encoder's step costs (theory, section 6; Abbott & Okamura 2005). The encoder shows y = u + q with an error
// |q| ≤ Δ/2 (a flooring one: of a displacement that is Δ/2 less). The law is linear in y, so that its motor makes what it
// would make of u, and besides
//     w_k = Σ_j h_j q_{k−j},    |w_k| ≤ K Δ/2,    K = Σ_j |h_j|
// with h its answer to a unit pulse of position. K is the least such number: some errors within ±Δ/2 attain it. For a lone
// spring it is the spring, for k0 and Maxwell elements k0 + 2 Σ c_i. Delay and amplifier lag do not raise it: held
// late, or averaged, w stays as small. Over a path the motor gives with it at most (K Δ/2) ∫|u̇| dt more than the certificate
// speaks of, and friction takes f_c ∫|u̇| dt. So with a certificate, whatever the motion,
//     energy taken up by motor, brake and mechanics ≥ −(K Δ/2 − f_c)⁺ ∫|u̇| dt − K Δ²/8
// where the last term is the static spring's tension under half a step with which a flooring encoder starts, at most, and
// is not there for a rounding one. For K ≤ 2 f_c/Δ friction pays for all of it; no brake does, which is off at rest.
#pragma once

#include "certify/estimator_factors.hpp"

namespace dashpot::compiler {

// K [N/m], to rounding; empty where the motor follows an estimate that nothing is known of. For FOAW the sum of both
// parts' bounds: whatever window it chooses, v̂ is off by at most Δ/T.
std::optional<double> quantisation_gain(const MotorConstants& motor, const SampledLoop& loop);

}  // namespace dashpot::compiler
