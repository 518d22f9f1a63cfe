// Whether a law is well formed: checked in every build, after each pass that makes or changes one.
#pragma once

#include <string_view>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// Throws std::logic_error, which names the pass, unless: every id lies in its table and every operand before what works
// on it; vectors meet scalars and vectors of their own size alone; `output` and `energy` assign locals, `keep` states;
// locals are assigned once, and before they are read, in their own phase (`keep` is part of the output's); `update` and
// `energy` read no input; force, brake and stored energy are assigned; every constant has values and a role.
void check_law(const UpdateLaw& law, std::string_view pass);

}  // namespace dashpot::compiler
