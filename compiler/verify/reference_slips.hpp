// A network with slips as its law renders it, and the least of its cuts, once more in 100 digits.
#pragma once

#include <vector>

#include "decompose/slip_decomposition.hpp"
#include "verify/reference_constants.hpp"
#include "verify/reference_tree.hpp"

namespace dashpot::compiler {

// As the laws compute it: under the gated law without the dampers beside slips.
ReferenceTree rendered_tree(ReferenceTree tree, const Network& network, const SlipDecomposition& slips);

// The least cut through springs, dampers and modes, each side of which no slip crosses (certify/cut.hpp): Σ k0/2 + Σ
// c/(1 + a) and Σ b∞.
struct ReferenceCut {
  Reference stiffness, damping;
  Reference brakes = 0;  // of `damping`, what the brake has in every regime, and is taken off

  // The dampers that are left to the motor; 0 if what is left is rounding only.
  Reference of_motor() const;
};
ReferenceCut reference_cut(const ReferenceForm& form, const LawFacts& facts);
ReferenceCut reference_cut(const ReferenceTree& tree, const Network& network, const SlipDecomposition& slips,
                           const LawFacts& facts, double lateness);

}  // namespace dashpot::compiler
