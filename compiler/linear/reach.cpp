#include "linear/reach.hpp"

#include <algorithm>
#include <utility>

#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

template <class Kind>
bool are_near(const Network& network, std::string_view kinds, Diagnostics& diagnostics) {
  const Element* least = nullptr;
  const Element* most = nullptr;
  for (const Element& element : network.elements) {
    if (!element.has_effect || !std::holds_alternative<Kind>(element.law) || value_of(element.law) == 0) continue;
    if (least == nullptr || value_of(element.law) < value_of(least->law)) least = &element;
    if (most == nullptr || value_of(element.law) > value_of(most->law)) most = &element;
  }
  if (least == nullptr || value_of(most->law) / widest_spread <= value_of(least->law)) return true;
  diagnostics.report<DiagnosticCode::values_far_apart>(least->span, kinds, least->name, value_of(least->law),
                                                       most->name, value_of(most->law), widest_spread);
  return false;
}

bool are_small(const Network& network, std::size_t most_nodes, Diagnostics& diagnostics) {
  const Part largest = largest_part(network);
  if (largest.internal.size() <= most_nodes) return true;
  const Element& first = network.elements[largest.elements.front()];
  diagnostics.report<DiagnosticCode::part_too_large>(first.span, first.name, largest.internal.size(), most_nodes);
  return false;
}

}  // namespace

Part largest_part(const Network& network) {
  Part largest;
  for (Part& part : independent_parts(network, effective_elements(network), tool, ground))
    if (part.internal.size() > largest.internal.size()) largest = std::move(part);
  return largest;
}

bool is_within_reach(const Network& network, Diagnostics& diagnostics, std::size_t most_nodes) {
  const bool springs = are_near<Spring>(network, "springs", diagnostics);
  const bool dampers = are_near<Damper>(network, "dampers", diagnostics);
  return springs && dampers && are_small(network, most_nodes, diagnostics);
}

}  // namespace dashpot::compiler
