#include "network/stuck_and_open_slips.hpp"

#include <vector>

#include "network/disjoint_sets.hpp"
#include "network/effect.hpp"
#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

// Leaves an effect to what lies on a path from tool to ground.
Network along(const std::vector<bool>& passable, Network network) {
  const std::vector<bool> on_path = on_path_between_ends(network, passable);
  for (std::size_t i = 0; i < on_path.size(); ++i) network.elements[i].has_effect = on_path[i];
  return network;
}

}  // namespace

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
