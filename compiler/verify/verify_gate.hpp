// Whether the numbers of a gate in a header keep the promise of theory, section 12, whatever they were chosen by.
#pragma once

#include "axes/viscous_field.hpp"
#include "network/axes_device.hpp"
#include "source/diagnostic.hpp"
#include "verify/header_constants.hpp"

namespace dashpot::compiler {

// In: the gate that network and device compile to, for numbers that share a name with an equal one, the device, and the
// header's constants. The weights |e_j| of the velocity estimates are those with which
// the runtime's own estimators answer a step of the position. Reports: factors of the allowances whose product is more
// than 4 (1 − ε_1)(1 − ε_2)(h/T_max)², which is all there is for any ω; limits that are shared by less than Σ |e_j|; a
// reserve below what the limits may grow by in the meantime, recovery · Σ |e_j| (n + j − 1).
void verify_gate(const axes::CurlGate& gate, const AxesDevice& device, const HeaderConstants& header,
                 Diagnostics& diagnostics);

}  // namespace dashpot::compiler
