// A network with slips as blocks and slips once more, by code that shares nothing with linear/ and decompose/: every block's
// canonical form in 100 digits, from a network of its own elements.
#pragma once

#include <optional>
#include <vector>

#include "network/tree.hpp"
#include "verify/reference_form.hpp"

namespace dashpot::compiler {

struct ReferencePart {
  enum class Kind { block, slip, series, parallel };
  Kind kind;
  Tree linear = {};           // of a block
  ReferenceForm form;         // of a block
  Reference yield_force = 0;  // of a slip
  std::vector<ReferencePart> children;
};

// What reaches ground without a slip, and the components with slips beside it.
struct ReferenceTree {
  ReferenceForm linear;
  std::vector<ReferencePart> components;
};

// Empty for a network that is no tree.
std::optional<ReferenceTree> reference_tree(const Network& network);

std::size_t slip_count(const ReferencePart& part);

// The same component without the dampers that lie beside its slips.
ReferencePart without_dampers_beside_slips(ReferencePart part);

// b∞ where slip i, in the order of the parts, slides if bit i of the pattern is set and holds else; empty where that is rigid.
std::optional<Reference> feedthrough_in(const ReferencePart& part, std::size_t pattern);

}  // namespace dashpot::compiler
