// The damping needed by a motor that follows a velocity estimate whose coefficients change from sample to sample,
// proved by one storage function for all of them.
//
// An adaptive window (FOAW) may take any of the windows n = 1 … N (theory, section 6b, "Adaptive windows"). With window
// n the estimate is a mean of the last n differences, with weights w_{n,j}.
//
// For the gain g of an estimate that drives no states there is a table: the least damping with one storage function for
// all windows, as a multiple of |g|, by the sign of g, the delay and N. The tables are data, windows/*.txt, in whole
// numbers; windows/search.py finds them. Outside the tables the bound follows from the inequalities of Jensen and of
// Cauchy and Schwarz.
//
// A difference over the time that has passed, v̂ = Δu/T_k, T₁ ≤ T_k ≤ T₂ (theory, section 6b, "Measured intervals"):
// V = p v̂², with p = |g| √(T₁T₂)/2, needs b = |g| (T₁ + T₂)/(2 √(T₁T₂)), at any delay.
#pragma once

#include <optional>

#include "certify/storage_function.hpp"

namespace dashpot::compiler {

struct WindowStorage {
  double factor = 0;  // b/|g|
  // P over the remembered variables, for |g| = 1 and T = 1: the displacements q0 … q_{delay+N−1}, or q0 … q_delay
  // followed by the estimates
  dashpot_check::Storage storage;
};

// For a gain of that sign: at punctual samples; for measured intervals that vary, h/T_max times what is needed under
// jitter; beyond windows of 15 or delays of 3, by means of γ. Empty for other estimators, where more than 32
// displacements are remembered, and behind an amplifier's lag.
std::optional<WindowStorage> window_storage(const SampledLoop& loop, double gain);

// γ of ‖v̂‖₂ ≤ γ ‖Δu/T‖₂, not below it; γ² = Σ_j max_n w_{n,j}: by Jensen's inequality v̂_k² ≤ Σ_j w_{n(k),j}
// (Δu_{k−j}/T)², and each difference is used at most once at every age j. Empty for other estimators.
std::optional<double> adaptive_window_gain(const SampledLoop& loop);

// An upper bound of the damping needed for the motor's response to the estimate [N·s/m], at punctual samples; for
// measured intervals that vary, h/T_max times what is needed. By the factor above, or by γ and the largest gain at any
// frequency. Empty for other estimators.
std::optional<double> damping_for_estimate(const MotorConstants& motor, const SampledLoop& loop);

// The storage function of the whole motor: that of its position-driven part plus that of the table. Proved for every
// window; empty if there is none for the estimate.
std::optional<StorageProof> adaptive_storage_proof(const MotorConstants& motor, const SampledLoop& loop);

}  // namespace dashpot::compiler
