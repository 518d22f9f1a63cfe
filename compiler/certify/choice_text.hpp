// What was chosen on a device, in words.
#pragma once

#include <string>

#include "decompose/decomposition.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {

// What a network has beside its slips, of which alone an error over frequency speaks.
enum class Beside { no_slips, linear, nothing };

// One sentence on `faithful`: its b, what it gains and costs against the paper's rule, how it moves over the device's
// assumed values, and where the brake has nothing to do, why. Empty for another choice, and without a device. `reach`:
// of the brake [N·s/m], behind a static curve where that is steepest; `zero_frequency_damping`: Z_d(0) [N·s/m].
std::string choice_in_words(const Decomposition& decomposition, const PortUnits& units, double reach,
                            bool is_behind_curve, double zero_frequency_damping, double feedthrough_damping,
                            Beside beside);

// Which state input `faithful` came with.
std::string reason_for_faithful(const Candidate& chosen, const Choices& choices);

// A share in per cent, without an exponent: "1346", "5.65".
std::string in_percent(double share);

}  // namespace dashpot::compiler
