// What emitted code answers, once the system's compiler has made a program of it.
#pragma once

#include <vector>

#include "differential_case.hpp"

namespace dashpot::testing {

// Emits, compiles and runs all cases as one program. Out: one answer a sample, in the order of the cases. Throws
// std::runtime_error where a case is not emitted or the program is not made.
std::vector<std::vector<Answer>> emitted_answers(const std::vector<DifferentialCase>& cases);

// Where the two differ in a bit; empty where they do not.
std::string first_difference(const std::vector<Answer>& evaluated, const std::vector<Answer>& emitted);

}  // namespace dashpot::testing
