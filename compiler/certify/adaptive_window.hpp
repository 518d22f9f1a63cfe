// What a motor needs that follows an estimate whose coefficients change from sample to sample: one storage function for
// all of them.
//
// An adaptive window (FOAW) takes any of the windows n = 1 … N (theory, section 6b, "Adaptive windows"). Of every n the
// estimate is a mean of the last n differences, with weights w_{n,j}.
//
// For the gain g of an estimate that drives no states there is a table: the least damping with one storage function for
// all windows, as a multiple of |g|, by the sign of g, the delay and N. The tables are data, windows/*.txt, in whole
// numbers; windows/search.py finds them. Beyond them, Jensen, Cauchy and Schwarz.
//
// A difference over the time that has passed, v̂ = Δu/T_k, T₁ ≤ T_k ≤ T₂ (theory, section 6b, "Measured intervals"):
// V = p v̂², with p = |g| √(T₁T₂)/2, needs b = |g| (T₁ + T₂)/(2 √(T₁T₂)), however late.
#pragma once

#include <optional>

#include "certify/storage_function.hpp"

namespace dashpot::compiler {

struct WindowStorage {
  double factor = 0;  // b/|g|
  // P over what is remembered, the displacements q0 … q_{delay+N−1}, or q0 … q_delay and the estimates behind them, of
  // |g| = 1, T = 1
  dashpot_check::Storage storage;
};

// Of a gain of that sign, at punctual samples, or of intervals that vary h/T_max times what is needed under jitter;
// beyond windows of 15 or delays of 3, of γ. Empty for other estimators, where more than 32 displacements are
// remembered, and behind an amplifier's lag.
std::optional<WindowStorage> window_storage(const SampledLoop& loop, double gain);

// γ of ‖v̂‖₂ ≤ γ ‖Δu/T‖₂, not below it; γ² = Σ_j max_n w_{n,j}: by Jensen's inequality v̂_k² ≤ Σ_j w_{n(k),j}
// (Δu_{k−j}/T)², and each difference is used at most once at every age j. Empty for other estimators.
std::optional<double> adaptive_window_gain(const SampledLoop& loop);

// Not below the damping that suffices for what the motor makes of the estimate [N·s/m], at punctual samples or of
// intervals that vary h/T_max times that; of the factor above, or of γ and the largest gain at any frequency. Empty for
// other estimators.
std::optional<double> damping_for_estimate(const MotorConstants& motor, const SampledLoop& loop);

// The storage functions of what position drives and of the table added up: V of the whole motor. Proved for every
// window; empty where there is none of the estimate.
std::optional<StorageProof> adaptive_storage_proof(const MotorConstants& motor, const SampledLoop& loop);

}  // namespace dashpot::compiler
