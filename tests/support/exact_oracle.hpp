// The dynamic stiffness of a network by eliminating its nodes one by one at one frequency: no modes, no matrices,
// nothing of the compiler's own linear stage.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "network/network.hpp"

namespace dashpot::testing {

using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>, boost::multiprecision::et_off>;

struct ExactComplex {
  Exact real = 0;
  Exact imaginary = 0;
};

ExactComplex operator+(const ExactComplex& x, const ExactComplex& y);
ExactComplex operator-(const ExactComplex& x, const ExactComplex& y);
ExactComplex operator*(const ExactComplex& x, const ExactComplex& y);
ExactComplex operator/(const ExactComplex& x, const ExactComplex& y);
Exact magnitude(const ExactComplex& x);

// D(s) [N/m] at the tool with ground held, springs being K and dampers sB; s [1/s]. The network has springs and dampers
// only; elements without effect do not matter. 60 digits, of which the star–mesh transformation loses a few.
ExactComplex dynamic_stiffness_by_elimination(const compiler::Network& network, const ExactComplex& s);

// The same at s = jω.
ExactComplex dynamic_stiffness_by_elimination(const compiler::Network& network, const Exact& angular_frequency);

}  // namespace dashpot::testing
