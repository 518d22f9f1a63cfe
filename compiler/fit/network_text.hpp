// The whole network file of a fit.
#pragma once

#include "fit/fit.hpp"

namespace dashpot::compiler::fitting {

// With the name, the tree and the curve, as far as there is its text: enough to read the values back.
std::string bare_network_text(const Fit& fit);

// With source, validity and what is known of the fit. Validity is what the recordings themselves covered: the fastest
// speed, the displacements from the tool's zero, and frequencies from one over 2π times the longest recording to one
// over 2π times the shortest step; of a spectrum its own.
std::string network_text(const Fit& fit, const Problem& problem);

// Of a surface, in all of its digits: "2.3 mm".
std::string place_text(double place, motion port_motion);

// The unit of what is left over: "N", or "%" where rows are weighted by their own size.
std::string error_unit(const Fit& fit, const Problem& problem);
std::string error_text(double rms, const Fit& fit, const Problem& problem, int digits = 4);

// What a recording consists of, beside its position: "N", "N/m", "m/N".
std::string measured_unit(const Fit& fit, const Problem& problem);

}  // namespace dashpot::compiler::fitting
