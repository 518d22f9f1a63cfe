// What a linear network must be, and whether it does anything where its author says it is valid.
#pragma once

#include "linear/linear_form.hpp"

namespace dashpot::compiler {

// False, with a diagnostic for each, where the network has slips or contact.
bool is_linear(const Network& network, Diagnostics& diagnostics);

// Warns: no relaxation inside the stated frequency band; tunable parameters taken at their default.
void warn_about_validity(const LinearForm& form, const Network& network, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
