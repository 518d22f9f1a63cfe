// Which law the brake follows behind slips: every one that can be had is run, and the tolerance rule decides.
#pragma once

#include "decompose/slip_laws.hpp"
#include "emit/emission.hpp"

namespace dashpot::compiler {

// In: a network with slips and what is chosen for what reaches ground without one. Sets the decomposition of what is
// behind slips: by the law asked for, or, of all whose error in a run is at most max(tolerance, 1.05 times the least
// reachable), of those certified with at most 1.05 times the least added damping among these, the one in which the
// brake is largest on average; ties: the least noise in the motor. Without a device nothing has to be added, and where
// nothing can be certified that is not asked.
void choose_slip_law(Compilation& compilation, const SlipDecomposer& behind_slips, const Choices& choices);

// The same on another device, that of `c`, with the chosen state input and the law that it has behind its slips: the
// damping beside them [N·s/m] that `faithful` takes there.
double damping_on_another_device(const Compilation& c, const SlipDecomposer& behind_slips, const Choices& choices);

}  // namespace dashpot::compiler
