// Random networks for property tests, as values and as the text that a user would write.
#pragma once

#include <cstdint>
#include <string>

#include "network/network.hpp"

namespace dashpot::testing {

enum class Topology { tree, graph };

struct NetworkRecipe {
  Topology topology = Topology::tree;
  std::size_t most_nodes = 30;   // tool and ground included; at least two
  double smallest_value = 1e-4;  // stiffness, damping or yield force [SI]; spread evenly over the decades
  double largest_value = 1e4;
  std::size_t most_slips = 0;  // springs and dampers only, unless some are asked for
};

// Ensures: the same network for the same seed and recipe; every element has an effect; slips alone never join tool and
// ground. Some networks take their values from a few powers of ten, so that equal relaxation times, symmetric bridges
// and other coincidences occur; in some nearly all elements are of one kind.
compiler::Network random_network(std::uint64_t seed, const NetworkRecipe& recipe = {});

// A network file in format 1 with `elements`; reading it gives the same elements with the same values to the last bit.
std::string json_text(const compiler::Network& network);

// Drops the elements through which no force passes and the nodes that nothing ends at. Returns false, leaving the
// network as it was, where tool and ground would be joined by nothing or by slips alone.
bool tidy(compiler::Network& network);

}  // namespace dashpot::testing
