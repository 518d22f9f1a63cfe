#include "network/stuck_and_open_slips.hpp"

#include <utility>
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
  return along(passable, std::move(network));
}

Network with_open_slips(Network network) {
  std::vector<bool> passable;
  for (const Element& element : network.elements) passable.push_back(element.has_effect && !is_slip(element.law));
  return along(passable, std::move(network));
}

}  // namespace dashpot::compiler
