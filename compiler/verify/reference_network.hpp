// Slips that meet in a part of a network that is no tree, once more by code that shares nothing with
// linear/multiport_form: what springs and dampers do between the slips' ends, the tool and the ground, in 100 digits.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "verify/reference_pencil.hpp"

namespace dashpot::compiler {

// k w wᵀ s/(s + λ)
struct ReferenceNetworkMode {
  Reference stiffness;                // k [N/m]
  Reference relaxation_rate;          // λ [1/s]
  ReferenceVector weights;            // w of every end: largest magnitude 1 among all but the ground
  std::vector<std::size_t> elements;  // of the springs and dampers that it comes from, in ascending order
};

struct ReferenceNetwork {
  std::vector<NodeIndex> ends;       // of slips, then the tool, then the ground
  ReferenceMatrix springs, dampers;  // what joins two ends
  std::vector<ReferenceNetworkMode> modes;
  std::vector<std::pair<NodeIndex, NodeIndex>> slips;  // their ends; slips side by side are one
  std::vector<Reference> yield_forces;                 // one each
};

// Of some of a network's elements. Modes of one rate, to 1e-25, stand for the sum of their k w wᵀ, taken apart end by
// end.
ReferenceNetwork reference_network(const Network& network, const std::vector<std::size_t>& elements);

}  // namespace dashpot::compiler
