// The map of a static curve once more, by code that shares nothing with linear/motion_map: the work along the curve by
// numerical quadrature of the force, in 100 digits.
#pragma once

#include "verify/reference_form.hpp"

namespace dashpot::compiler {

// The tables of a map of so many cubics, as they are emitted: each cubic, then the straight end.
struct ReferenceMap {
  std::vector<Reference> begins, a, b, c, e;
};

// Of a network whose linear part is `form`; of a curve at once, that of the network while its slips hold.
ReferenceMap reference_map(const Network& network, const ReferenceForm& form, std::size_t cubics);

}  // namespace dashpot::compiler
