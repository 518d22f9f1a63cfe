// The table of a coupled tree, from which dashpot::slip_tree takes its steps.
#pragma once

#include <dashpot/slip_tree.hpp>

#include <vector>

#include "decompose/choices.hpp"
#include "linear/normal_form.hpp"
#include "linear/real.hpp"

namespace dashpot::compiler {

struct SlipTable {
  std::vector<slip_node<double>> nodes;   // breadth first, the root at 0
  std::vector<const NormalTree*> blocks;  // by the place of their nodes; pointers into the component
  std::vector<const NormalTree*> slips;   // the same
};

// `stiffness` gives g of every block in the order of SlipTable::blocks. Numbers are rounded to `scalar`.
SlipTable slip_table(const NormalTree& component, const std::vector<Real>& stiffness, ScalarType scalar);

// The blocks in the order of the table.
std::vector<const NormalTree*> blocks_breadth_first(const NormalTree& component);

}  // namespace dashpot::compiler
