// What a step in a single function can leave out of output() and update(): copies from one to the other, and checks
// whose result is known already.
#pragma once

#include <map>
#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// In: a law without tunables. True where its two phases stand well in one function: where loops or coupled slips take
// the time, it would only be longer.
bool is_fusable(const UpdateLaw& law);

// The states that only carry a number of output() to update(), each with what it is a copy of.
std::map<VariableId, VariableId> carried_numbers(const UpdateLaw& law);

// The variables whose finiteness decides whether a sample is kept: the force, preceded by those inputs that may be
// non-finite while the force is finite. (Sums and products of a non-finite number are not finite.)
std::vector<VariableId> checked_numbers(const UpdateLaw& law);

}  // namespace dashpot::compiler
