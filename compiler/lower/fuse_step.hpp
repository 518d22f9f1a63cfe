// What step(), a single function, can leave out of output() and update(): copies from one to the other, and checks
// whose result is known.
#pragma once

#include <map>
#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// In: a law without tunables. True if writing its two phases as one function is worth it: if loops or coupled slips
// take the time, it would only make the code longer.
bool is_fusable(const UpdateLaw& law);

// The states that only carry a number from output() to update(), each with the variable that it copies.
std::map<VariableId, VariableId> carried_numbers(const UpdateLaw& law);

// The variables whose finiteness decides whether a sample is kept: the force, preceded by those inputs that may be
// non-finite while the force is finite. (Sums and products of a non-finite number are not finite.)
std::vector<VariableId> checked_numbers(const UpdateLaw& law);

}  // namespace dashpot::compiler
