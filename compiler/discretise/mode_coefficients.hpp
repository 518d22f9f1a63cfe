// The constants of one mode's update, F_k = a F_{k−1} + c Δu, in extended precision (theory, section 3).
#pragma once

#include "decompose/choices.hpp"
#include "linear/linear_form.hpp"

namespace dashpot::compiler {

struct ModeCoefficients {
  Real decay;          // a [1]
  Real loss;           // α = 1 − a, without cancellation [1]
  Real position_gain;  // c through springs: force for a displacement between samples [N/m]
  Real velocity_gain;  // c h through dampers: force for a velocity [N·s/m]
};

// exact: a = e^{−λh}, c = k (1 − a)/(λh). backward-euler: a = 1/(1 + λh), c = k a.
ModeCoefficients mode_coefficients(const Mode& mode, Scheme scheme, StateInput input, const Real& sample_period);

// How stiff it is to a step within one sample, g = k0 + b∞/h + Σ c [N/m]
Real companion_stiffness(const LinearForm& form, Scheme scheme, const Real& sample_period);

}  // namespace dashpot::compiler
