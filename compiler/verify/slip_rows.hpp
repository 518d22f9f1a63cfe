// One step of a component with a single slip, as rows of coefficients (theory, section 5, closed form), once more in
// 100 digits: what a displacement of the tool, a force held in a block and the slip's excess make of the trial force,
// the component's force and every block's elongation.
#pragma once

#include <vector>

#include "verify/reference_tree.hpp"

namespace dashpot::compiler {

struct ReferenceRow {
  Reference change;             // for Δu
  std::vector<Reference> held;  // for π of each block, in the order of blocks_of()
  Reference excess;             // for r
};

struct SlipRows {
  ReferenceRow trial, force;
  std::vector<ReferenceRow> elongation;  // one a block
};

std::vector<const ReferencePart*> blocks_of(const ReferencePart& component);

// `stiffness`: g of each block.
SlipRows slip_rows(const ReferencePart& component, const std::vector<Reference>& stiffness);

}  // namespace dashpot::compiler
