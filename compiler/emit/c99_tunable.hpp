// A law with tunable parameters as lines of C99: its tables, and the parts of templates/c99/ that read them.
#pragma once

#include "emit/c99_program.hpp"

namespace dashpot::compiler {

C99Program c99_tunable_program(const UpdateLaw& law, const std::string& name);

}  // namespace dashpot::compiler
