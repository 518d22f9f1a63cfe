// What rounding adds in one step of a linear law, as a proposition for Gappa.
#pragma once

#include <map>
#include <string>

#include "emit/emission.hpp"
#include "certify/state_box.hpp"

namespace dashpot::testing {

// Modes must be in product form. For any input in the range and any state in the box: a mode is off by no more than its
// share of what the header's banner states, be its constants rounded as they may; the force by no more than the
// certificate adds for the sum of its terms; and the states are in the box again. Gappa's `rnd=` rounds every operation
// of an expression; flushing, which adds less than 2⁻²⁰⁰ N (2⁻⁶⁰ N in float), is left out.
std::string gappa_script(const compiler::Compilation& compilation, const compiler::InputRange& range,
                         const compiler::StateBox& box);

}  // namespace dashpot::testing
