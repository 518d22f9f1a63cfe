#pragma once

#include "law/update_law.hpp"

namespace dashpot::compiler {

// A law without tables and programs, of the same scalar and sampling.
UpdateLaw empty_law_like(const UpdateLaw& law);

}  // namespace dashpot::compiler
