// What a motor needs that follows an adaptive window (FOAW), whichever of the windows n = 1 … N a sample takes (theory,
// section 6b, "Adaptive windows"). Of every n the estimate is a mean of the last n differences, with weights w_{n,j}.
//
// For the gain g of an estimate that drives no states there is a table: the least damping with one storage function for
// all windows, as a multiple of |g|, by the sign of g, the delay and N. The tables are data, windows/*.txt, in whole
// numbers; windows/search.py finds them. Beyond them, Jensen, Cauchy and Schwarz.
#pragma once

#include <optional>

#include "certify/storage_function.hpp"

namespace dashpot::compiler {

struct WindowStorage {
  double factor = 0;               // b/|g|
  dashpot_check::Storage storage;  // P over the remembered displacements q0 … q_{delay+N−1} of |g| = 1, T = 1
};

// Of a gain of that sign; beyond windows of 15 or delays of 3, of γ. Empty for other estimators, where more than 32
// displacements are remembered, and behind an amplifier's lag.
std::optional<WindowStorage> window_storage(const SampledLoop& loop, double gain);

// γ of ‖v̂‖₂ ≤ γ ‖Δu/T‖₂, not below it; γ² = Σ_j max_n w_{n,j}: by Jensen's inequality v̂_k² ≤ Σ_j w_{n(k),j}
// (Δu_{k−j}/T)², and each difference is used at most once at every age j. Empty for other estimators.
std::optional<double> adaptive_window_gain(const SampledLoop& loop);

// Not below the damping that suffices at punctual samples for what the motor makes of the estimate [N·s/m]; of the
// factor of the table, or of γ and the largest gain at any frequency. Empty for other estimators.
std::optional<double> damping_for_estimate(const MotorConstants& motor, const SampledLoop& loop);

// The storage functions of what position drives and of the table added up: V of the whole motor. Proved for every
// window; empty where there is none of the estimate.
std::optional<StorageProof> adaptive_storage_proof(const MotorConstants& motor, const SampledLoop& loop);

}  // namespace dashpot::compiler
