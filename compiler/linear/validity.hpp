// Checks of a network's form: whether it can be solved in bounded time, and whether it relaxes in its valid band.
#pragma once

#include "linear/normal_form.hpp"

namespace dashpot::compiler {

// The normal form of a network whose step takes a number of operations known beforehand. Refuses: more slips outside
// a tree than can be solved in a bounded time.
std::optional<NormalForm> closed_normal_form(const Network& network, Diagnostics& diagnostics);

// Warns: no relaxation inside the stated frequency band.
void warn_about_validity(const LinearForm& form, const Network& network, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
