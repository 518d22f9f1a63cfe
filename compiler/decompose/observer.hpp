// Which element of every series connection is observed, and the damping that the brake takes over: the paper's rule,
// §5.1, with theory, section 4.
#pragma once

#include <optional>
#include <string>

#include "linear/linear_form.hpp"
#include "network/tree.hpp"

namespace dashpot::compiler {

enum class ObserverRule {
  most_dissipative,  // in series, the child with the largest share of the dissipation
  largest,           // in series, the child with the largest damping
};

struct Observation {
  Real damping;         // [N·s/m] or [N·m·s/rad]
  std::string reason;   // one clause for each series connection with a choice
  Network realisation;  // the same network, rewired so that every observed child is next to the tool
};

// Walks the tree from the tool: in parallel dampings add; in series the observed child's is taken. Shares are compared
// at `reference_frequency` [rad/s], 0 for the limit ω → 0. Children in series that are multiples of each other (equal
// relaxation times, springs, dampers) are merged first; the larger damping wins a tie.
Observation observe(const Tree& tree, const Network& network, ObserverRule rule, double reference_frequency);

}  // namespace dashpot::compiler
