// Findings of a fit: what its recordings cannot tell.
#pragma once

#include "fit/fit.hpp"

namespace dashpot::compiler::fitting {

// Standard deviation of the force's noise, which no model can explain, from second differences; empty if rows are so
// far apart that the motion itself shows in them, and for spectra.
std::optional<double> noise_of(const Problem& problem);

// In: a fit that is complete but for its findings.
std::vector<Finding> findings_of(const Fit& fit, const Problem& problem, const Uncertainty& uncertainty,
                                 bool size_was_met);

// How long after the position the force was recorded, in whole rows [s]: 0 if no delay explains the recording much
// better.
double force_delay(const Recording& recording);

}  // namespace dashpot::compiler::fitting
