#include "network/stuck_slips.hpp"

#include <vector>

#include "network/disjoint_sets.hpp"
#include "network/effect.hpp"
#include "network/law.hpp"

namespace dashpot::compiler {

Network with_stuck_slips(Network network) {
  DisjointSets joined(network.nodes.size());  // by the least, so that tool and ground stay what they are
  for (const Element& element : network.elements)
    if (element.has_effect && is_slip(element.law)) joined.unite_by_least(element.a, element.b);
  std::vector<bool> passable;
  for (Element& element : network.elements) {
    element.a = joined.find(element.a);
    element.b = joined.find(element.b);
    passable.push_back(element.has_effect && element.a != element.b);
  }
  const std::vector<bool> on_path = on_path_between_ends(network, passable);
  for (std::size_t i = 0; i < on_path.size(); ++i) network.elements[i].has_effect = on_path[i];
  return network;
}

}  // namespace dashpot::compiler
