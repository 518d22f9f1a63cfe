// The network's equations as MathML, with its numbers.
#pragma once

#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// D(s) in letters, then with this network's numbers, then the modes as a table.
std::string canonical_form_html(const Compilation& compilation);

// What the emitted code does at each sample, statement by statement, from the law itself.
std::string update_law_html(const Compilation& compilation);

// Of a network with tunables, before its statements: parameters, what follows them, and what that costs.
std::string tunable_law_html(const Compilation& compilation);

// What the brake is told: one number, or "2.5 to 3.3" where it changes.
std::string brake_text(const UpdateLaw& law);

}  // namespace dashpot::compiler
