// Quasi-linear viscoelasticity, the usual law of a tissue with a static curve, for comparison with the map used here.
#pragma once

#include "linear/linear_form.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

// In: a network with its map, its form, the speed of a ramp from the curve's start to the map's reach [m/s]. Out: how
// far the two forces are apart at most on that ramp, over the largest of the map's [1]. Both rest with the same force
// and relax alike; damping goes with f_e′ in the one and with w′² in the other (theory, section 11).
double distance_from_quasi_linear(const Network& network, const LinearForm& form, double speed);

}  // namespace dashpot::compiler
