// A law with tunable parameters as lines of C++: its tables, and calls of dashpot::tunable_law.
#pragma once

#include "emit/cpp_program.hpp"

namespace dashpot::compiler {

// As the tables call it, in C++ and in C.
const char* name_of(tunable_kind kind);

CppProgram tunable_program(const UpdateLaw& law);

}  // namespace dashpot::compiler
