// The closed forms of a linear network as plots: theory, sections 2 and 3.
#pragma once

#include <string>

#include "emit/emission.hpp"
#include "report/axis.hpp"

namespace dashpot::compiler {

// Relaxation, creep, storage and loss modulus, loss tangent: four figures.
std::string linear_responses_html(const Compilation& compilation);

// The frequencies at which something happens, with two decades around [Hz]; for a network without modes two decades
// around the corner of its Kelvin element, or around 1 Hz.
Interval frequencies_of_interest(const LinearForm& form);

}  // namespace dashpot::compiler
