// What the constants of a law with slips or a contact may be, recomputed in 100 digits. A constant's kind is told by
// the end of its name; the code around it, which a second compilation gives, tells whose it is.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "decompose/slip_decomposition.hpp"
#include "verify/reference_constants.hpp"
#include "verify/reference_tree.hpp"

namespace dashpot::compiler {

using Pool = std::map<std::string, std::vector<Reference>, std::less<>>;

// What a constant may be by its name: "gain", "row", "yield", "table", …. None for what is chosen, and no function of
// the network alone; several where an element's name looks like a kind.
std::vector<std::string_view> kinds_behind_slips(std::string_view name);

// `tree`: a rendered one, here and below. `slips`: what the brake was given in every regime, and the encoder's step; a
// choice.
Pool constants_behind_slips(const ReferenceTree& tree, const Network& network, const SlipDecomposition& slips,
                            const LawFacts& facts);

// As the laws compute it: under the gated law without the dampers beside slips; behind a contact slips outside a tree
// with all others.
ReferenceTree rendered_tree(ReferenceTree tree, const Network& network, const SlipDecomposition& slips);

// Of all components and networks.
std::vector<std::size_t> elements_behind_slips(const ReferenceTree& tree);

// The least cut through springs, dampers and modes, each side of which no slip crosses (certify/cut.hpp): Σ k0/2 + Σ
// c/(1 + a) and Σ b∞.
struct ReferenceCut {
  Reference stiffness, damping;
  Reference brakes = 0;  // of `damping`, what the brake has in every regime, and is taken off

  // What the motor has left; nothing where that is left over from rounding.
  Reference of_motor() const;
};
ReferenceCut reference_cut(const ReferenceTree& tree, const Network& network, const SlipDecomposition& slips,
                           const LawFacts& facts, double lateness);

// False where the brake was given more of some regime's dampers than there are in it.
bool are_within_regimes(const ReferenceTree& tree, const SlipDecomposition& slips);

}  // namespace dashpot::compiler
