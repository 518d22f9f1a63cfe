// Tunable parameters as templates take them.
#pragma once

#include <vector>

#include "emit/code_model.hpp"
#include "law/update_law.hpp"

namespace dashpot::compiler {

// An entry for each: `tunable`, its name; `member`, the same in C; `unit`; `low` and `high`, its range for people;
// `value`, `min` and `max`, literals of that type, `bounds` and `range`, these in braces; `index`; and `variable`, the
// law's, as C99 and as C++ (`scalar_variable`) have it.
std::vector<Fields> tunable_fields(const UpdateLaw& law, ScalarType literals);

// The list of these, `tunables`; and of one entry, whichever holds, `no_tunable`, or `any_tunable` with their `count`
// and, in braces, their `first` values and those `wanted` of a struct.
void add_tunables(const UpdateLaw& law, CodeModel& model);

}  // namespace dashpot::compiler
