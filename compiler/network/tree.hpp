// The series–parallel structure of a network, whichever way it was written.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "network/network.hpp"

namespace dashpot::compiler {

// Flattened: no series directly below a series, no parallel below a parallel. Children in file order of their first
// element. Elements without effect do not appear.
struct Tree {
  enum class Kind { leaf, series, parallel };
  Kind kind;
  std::size_t element = 0;  // of a leaf: index into Network::elements
  std::vector<Tree> children;
};

// Empty for a network that is no tree (a bridge), or one nested more than 1,000 deep (a long ladder). A network in
// which nothing has an effect is a parallel of nothing.
std::optional<Tree> series_parallel_tree(const Network& network);

std::string to_text(const Tree& tree, const Network& network);

}  // namespace dashpot::compiler
