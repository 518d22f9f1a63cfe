// What `dashpot fit` says of a fit.
#pragma once

#include <string>

#include "fit/fit.hpp"
#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// Per file: rows, rms, R², the largest error with its place, correlation of neighbours, effective samples, gain; then
// the floor, every size that was tried, the elements with their intervals.
std::string fit_text(const fitting::Fit& fit, const std::vector<fitting::Recording>& recordings);

// All of it, SI units; `null` is what was not computed.
std::string fit_json(const fitting::Fit& fit, const std::vector<fitting::Recording>& recordings);

// One page: data and model of each file, what is left over time and displacement, the spectrum with intervals and what
// leaving a file out does, residual by size with the floor, held-out files.
std::string fit_page(const fitting::Fit& fit, const std::vector<fitting::Recording>& recordings,
                     const std::vector<fitting::Recording>& held_out, Diagnostics& diagnostics);

// Each finding as a warning with its remedy.
void report_findings(const fitting::Fit& fit, const std::vector<fitting::Recording>& recordings,
                     Diagnostics& diagnostics);

}  // namespace dashpot::compiler
