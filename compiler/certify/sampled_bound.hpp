// The largest damping that the sampled loop needs at any frequency, rigorously (theory, section 6b).
#pragma once

#include "certify/needed_damping.hpp"

namespace dashpot::compiler {

struct SampledBound {
  double needed = 0;     // upper bound of the supremum of S, within the precision below [N·s/m]
  double attained = 0;   // lower bound of the supremum [N·s/m]
  double frequency = 0;  // where S nearly reaches its supremum [Hz]
  std::size_t arcs = 0;  // number of arcs examined
};

// Limit on the number of modes times arcs. The search for a supremum hardly above the rounding of its terms might never
// end: after so many the bound is left as it is, above the supremum but less close.
inline constexpr std::size_t most_terms = 400'000;
inline constexpr double bound_precision = 4e-10;  // relative; and 1e-12 of the size of the terms, or rounding if larger

// Branch and bound over all frequencies from 0 to Nyquist: the arc with the highest bound is halved until that bound is
// within the precision of what is attained. Every bound is outward.
SampledBound sampled_bound(const NeededDamping& needed, double sample_period, std::size_t terms = most_terms);

}  // namespace dashpot::compiler
