// What recordings cannot tell, said of a fit.
#pragma once

#include "fit/fit.hpp"

namespace dashpot::compiler::fitting {

// Standard deviation of what no model can explain, by second differences of the force: nothing where rows are so far
// apart that the motion itself is in them, and for spectra.
std::optional<double> noise_of(const Problem& problem);

// In: a fit that is complete but for its findings.
std::vector<Finding> findings_of(const Fit& fit, const Problem& problem, const Uncertainty& uncertainty,
                                 bool size_was_met);

// The share of a delay's rows by which the force follows the position: 0 where none explains the recording much better.
double force_delay(const Recording& recording);

}  // namespace dashpot::compiler::fitting
