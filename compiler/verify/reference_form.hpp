// The canonical form of a linear network once more, by code that shares nothing with linear/: dense matrices of 100
// digits, Householder's reduction and the QL method, for checking what the compiler emitted.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <vector>

#include "network/network.hpp"

namespace dashpot::compiler {

using Reference =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

struct ReferenceMode {
  Reference stiffness;        // k [N/m] or [N·m/rad]
  Reference relaxation_rate;  // λ [1/s]
  Reference spring_share;     // of its drive [1]
};

struct ReferenceForm {
  Reference static_stiffness = 0;     // k0
  Reference feedthrough_damping = 0;  // b∞
  std::vector<ReferenceMode> modes;  // by ascending relaxation rate; rates equal to 1e-12 merged, keeping Σk and Σk/λ
};

// Of springs and dampers only.
ReferenceForm reference_form(const Network& network);

}  // namespace dashpot::compiler
