// A network with slips as a tree of linear blocks and slips (theory, section 5): every linear part is one block with
// its canonical form, every part of slips alone one slip.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "linear/linear_form.hpp"
#include "network/tree.hpp"

namespace dashpot::compiler {

struct NormalTree {
  enum class Kind { block, slip, series, parallel };
  Kind kind;
  LinearForm form;                    // of a block
  Real yield_force = 0;               // of a slip, those side by side summed before they are rounded [N] or [N·m]
  std::vector<std::size_t> elements;  // of a block or slip: indices into Network::elements
  std::vector<NormalTree> children;   // of series and parallel: no two blocks, no two slips, none of its own kind
};

struct NormalForm {
  LinearForm linear;                   // the part that joins tool and ground without a slip
  std::vector<NormalTree> components;  // in parallel with it: series, each with at least one slip
  // The same of parts that are no tree: indices into Network::elements. Behind a contact one of all slips, if any part
  // is no tree; there are no components then.
  std::vector<std::vector<std::size_t>> networks;

  bool has_slips() const { return !components.empty() || !networks.empty(); }
  bool is_all_behind_slips() const { return has_slips() && linear.is_empty(); }
};

// Without slips, `linear` is the canonical form of the whole.
NormalForm normal_form(const Network& network);

// The same network with everything that is behind a slip marked as without effect.
Network linear_part(const Network& network, const NormalForm& form);

// The whole network as one tree, for a contact: all that is behind the surface answers as one part.
NormalTree whole_tree(const NormalForm& form, const Network& network);

// Yield forces of the slips among these elements, by the nodes that they join; slips side by side add up.
std::map<std::pair<NodeIndex, NodeIndex>, Real> slips_between(const Network& network,
                                                              const std::vector<std::size_t>& elements);

// These slips, each with those side by side with it, in the order of slips_between(). Indices into Network::elements.
std::vector<std::vector<std::size_t>> slips_together(const Network& network, const std::vector<std::size_t>& elements);

// The number of slips in the tree.
std::size_t slip_count(const NormalTree& tree);

// The slips, breadth first; and all elements, ascending.
std::vector<const NormalTree*> slips_of(const NormalTree& tree);
std::vector<std::size_t> elements_of(const NormalTree& tree);

}  // namespace dashpot::compiler
