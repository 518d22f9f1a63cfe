// Whether the constants of a law are finite in its scalar type.
#pragma once

#include "law/update_law.hpp"
#include "network/network.hpp"
#include "source/diagnostic.hpp"

namespace dashpot::compiler {

bool has_finite_numbers(const UpdateLaw& law);

// Refuses, each once, constants that are not finite after rounding.
bool is_representable(const UpdateLaw& law, const Network& network, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
