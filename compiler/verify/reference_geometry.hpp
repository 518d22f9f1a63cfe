// The constants of a law of two axes that come from the device and the maps, not from a port's network, in 100 digits.
#pragma once

#include <map>
#include <string>

#include "emit/axes_emission.hpp"
#include "verify/reference_form.hpp"

namespace dashpot::compiler {

// By the names that a header gives them, as magnitudes: links and centres, the polynomials of sine and cosine, what is
// added to the brakes' commands and what they have left. A header has those that its law needs.
std::map<std::string, Reference> reference_geometry(const AxesCompilation& compilation);

}  // namespace dashpot::compiler
