// Finds the constant of a law that a number in its header stands for, and checks that it is the nearest to the exact
// value.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "compile.hpp"
#include "source/diagnostic.hpp"
#include "verify/header_constants.hpp"
#include "verify/reference_constants.hpp"

namespace dashpot::compiler {

struct LawConstant {
  const Coefficient* coefficient;
  std::size_t first;  // place of the header's first number among the constant's values
};

// Looks a constant up by its name in the header: its own, or that of one of its places where a vector is written as
// scalars. Empty if the law has no such constant, or not as many values.
std::optional<LawConstant> constant_called(const std::string& name, std::size_t values, const UpdateLaw& law);

// Whether it is one of the tables of a static curve's map, which are recomputed with the map.
bool is_table_of_map(const std::string& name, const UpdateLaw& law);

// Whether such a constant is a choice, or comes from the device or a map, and is no function of the network alone.
bool is_chosen(ConstantRole role);

// One of the numbers of a constant, for messages: its name in the header and, of a list, the place from 1.
std::string shown(const HeaderConstant& constant, std::size_t place);

// These report a value that is not the nearest number of the scalar's type; of a list the first, or that there are more
// or fewer.
void compare(const HeaderConstant& constant, std::size_t place, const Reference& exact, ScalarType scalar,
             Diagnostics& diagnostics);
void compare(const HeaderConstant& constant, const std::vector<Reference>& exact, ScalarType scalar,
             Diagnostics& diagnostics);

// Reports a constant whose numbers from place `first` on are not the header's; the first such number.
void compare_with_compiled(const HeaderConstant& constant, const LawConstant& compiled, Diagnostics& diagnostics);

// Reports numbers without a name that are none of these: what a state or a tuned number begins with, to either side
// where it is a yield force; what joins tool and ground in a part that is no tree; what a contact among slips holds,
// whatever pushes; `fixed_yields`, yield forces that no parameter changes.
void look_at_literals(const HeaderConstant& literals, const UpdateLaw& law, const std::vector<Reference>& fixed_yields,
                      Diagnostics& diagnostics);

// The same of a constant that no statement reads: sample period, threshold, and what of the brake does not change.
void compare_with_facts(const HeaderConstant& constant, const Compilation& compiled, const LawFacts& facts,
                        Diagnostics& diagnostics);

}  // namespace dashpot::compiler
