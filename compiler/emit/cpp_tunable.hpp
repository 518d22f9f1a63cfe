// A law with tunable parameters as lines of C++: its tables, and calls of dashpot::tunable_law.
#pragma once

#include "emit/cpp_program.hpp"

namespace dashpot::compiler {

CppProgram tunable_program(const UpdateLaw& law);

}  // namespace dashpot::compiler
