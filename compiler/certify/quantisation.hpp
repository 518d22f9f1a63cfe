// What the encoder's step costs (theory, section 6; Abbott & Okamura 2005). The encoder shows y = u + q with an error
// |q| ≤ Δ/2 (a flooring one: of a displacement that is Δ/2 less). The law is linear in y, so that its motor makes what
// it would make of u, and besides
//     w_k = Σ_j h_j q_{k−j},    |w_k| ≤ K Δ/2,    K = Σ_j |h_j|
// with h its answer to a unit pulse of position. K is the least such number: some errors within ±Δ/2 attain it. For a
// lone spring it is the spring, for k0 and Maxwell elements k0 + 2 Σ c_i. Delay and amplifier lag do not raise it: held
// late, or averaged, w stays as small. Over a path the motor gives with it at most (K Δ/2) ∫|u̇| dt more than the
// certificate allows, and friction takes f_c ∫|u̇| dt. So with a certificate, whatever the motion,
//     energy taken up by motor, brake and mechanics ≥ −(K Δ/2 − f_c)⁺ ∫|u̇| dt − K Δ²/8
// where the last term is the static spring's tension under half a step with which an encoder may start, at most. It
// comes once, and is not there where a rounding encoder starts on a count. For K ≤ 2 f_c/Δ friction pays for all of it;
// no brake does, which is off at rest.
//
// Slips. Beside the tool that goes y = u + q and moves the slips by p, think of one that goes u while the slips move by
// the same p. Between the two the law is linear: its motor's force differs by w, |w| ≤ K Δ/2, with K of the network in
// which every slip holds, and what a slip holds by |w_s| ≤ K_s Δ/2 (held_slips.hpp). The second tool's slips take up (Y
// ± w_s)|Δp|, which is not below zero where Y ≥ K_s Δ/2, for then the encoder's step alone makes no slip give way; and
// the certificate's cut (cut.hpp) applies to the second tool as it stands. So energy and K are bounded as above. A slip
// with all of the tool's force, Y < K Δ/2, leaves a force below K Δ/2 in any case. A brake's share x of some regime and
// an estimate that is compensated, κ v̂, are part of the law: the worst x counts, and κ Σ|pulse of v̂|. A contact. With
// the kernel g s_k − Σ w_j s_{k−j}, w_j ≥ 0 and Σ w_j ≤ g, of what is behind it, its surface s = max(u, Σ w_j
// s_{k−j}/g) differs by no more than u does: K is that of what is behind it. Parameters: K at the worst place of the
// box, between changes.
#pragma once

#include "certify/estimator_factors.hpp"
#include "certify/slip_motor.hpp"

namespace dashpot::compiler {

// K [N/m], to rounding; empty where the motor follows an estimate that nothing is known of. For FOAW the sum of both
// parts' bounds: whatever window it chooses, v̂ is off by at most Δ/T.
std::optional<double> quantisation_gain(const MotorConstants& motor, const SampledLoop& loop);

// Upper bound of K for a law with slips or a contact; `linear` is the part that reaches ground without a slip. Empty
// also if the encoder's step alone can make a slip give way.
std::optional<double> quantisation_gain(const MotorConstants& linear, const SlipMotor& slips, const SampledLoop& loop);

// Σ|h_j| of the velocity estimate itself [1/s]; empty if it is not known.
std::optional<double> estimate_pulse(const SampledLoop& loop);

}  // namespace dashpot::compiler
