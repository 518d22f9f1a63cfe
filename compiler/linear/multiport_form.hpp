// The canonical form of a linear part that slips join at several nodes: springs and dampers between its terminals, and
// modes that pull at several of them (theory, section 2, with vectors for p and q):
//     F(s) = [K0 + B∞ s + Σ k_i w_i w_iᵀ s/(s + λ_i)] X(s)
#pragma once

#include <vector>

#include "linear/linear_form.hpp"

namespace dashpot::compiler {

// A spring or damper between two terminals, by index; the ground comes after the last terminal.
struct Tie {
  std::size_t a, b;
  Real value;  // k [N/m] or b [N·s/m]
};

struct MultiportMode {
  Real stiffness;             // k [N/m]
  Real relaxation_rate;       // λ [1/s]
  std::vector<Real> weights;  // w of each terminal and the ground: largest magnitude 1 among the terminals, sum 0
  std::vector<std::size_t> elements;  // indices into Network::elements: where the mode comes from
};

struct MultiportForm {
  std::vector<NodeIndex> terminals;   // without the ground
  std::vector<Tie> springs, dampers;  // at most one for each pair
  std::vector<MultiportMode> modes;
};

// In: springs and dampers, and the terminals. The elements must tie every other node to terminals or the ground.
// Ensures: terminals that nothing joins have exactly no tie and no mode in common.
MultiportForm multiport_form(const Network& network, const std::vector<std::size_t>& elements,
                             const std::vector<NodeIndex>& terminals);

// The same for a part with slips, without the slips; terminals are the nodes at which slips end, then the tool.
MultiportForm multiport_form_at_slips(const Network& network, const std::vector<std::size_t>& elements);

}  // namespace dashpot::compiler
