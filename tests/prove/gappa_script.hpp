// What rounding adds in one step of a linear law, in double or float, straight or rolled, as propositions for Gappa.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "emit/emission.hpp"
#include "certify/state_box.hpp"

namespace dashpot::testing {

// Modes must be in product or delta form. For any input in the range and any state in the box: a mode is off by no more
// than its share of what the header's banner states, be its constants rounded as they may; the sum of the modes by no
// more than one unit for each, and the force by no more than eight of the sum of its terms, which together is what the
// banner says that rounding adds; and the states are in the box again. Gappa's `rnd=` rounds every operation of an
// expression; in delta form each mode is a proposition of its own, of which the others may assume that its state is in
// the box. Flushing, which adds less than 2⁻²⁰⁰ N (2⁻⁶⁰ N in float), is left out.
std::vector<std::string> gappa_scripts(const compiler::Compilation& compilation, const compiler::InputRange& range,
                                       const compiler::StateBox& box);

}  // namespace dashpot::testing
