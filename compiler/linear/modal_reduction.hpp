// Parts of a network that share no internal node, each reduced to modes at the port.
#pragma once

#include <span>
#include <vector>

#include "linear/linear_form.hpp"

namespace dashpot::compiler {

// Elements and the internal nodes that they join; no two parts share an internal node.
struct Part {
  std::vector<std::size_t> elements;  // indices into Network::elements
  std::vector<NodeIndex> internal;
  NodeIndex port;
  NodeIndex held;
};

std::vector<Part> independent_parts(const Network& network, std::span<const std::size_t> elements, NodeIndex port,
                                    NodeIndex held);

// Adds the part's static stiffness, feedthrough damping and modes, unmerged, to `form`: theory, section 2.
void add_part(LinearForm& form, const Part& part, const Network& network);

}  // namespace dashpot::compiler
