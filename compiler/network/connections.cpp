#include "network/connections.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "network/disjoint_sets.hpp"
#include "network/effect.hpp"
#include "network/law.hpp"
#include "network/name_rules.hpp"
#include "source/nearest_name.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t most_names_listed = 5;

std::string list_names(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most_names_listed); ++i)
    text += fmt::format("{}'{}'", i == 0 ? "" : ", ", names[i]);
  if (names.size() > most_names_listed) text += fmt::format(" and {} more", names.size() - most_names_listed);
  return text;
}

std::string list_names(const std::vector<const Element*>& elements) {
  std::vector<std::string> names;
  for (const Element* element : elements) names.push_back(element->name);
  return list_names(names);
}

DisjointSets connected_parts(const Network& network) {
  DisjointSets parts(network.nodes.size());
  for (const Element& element : network.elements) parts.unite(element.a, element.b);
  return parts;
}

std::vector<std::size_t> elements_at_nodes(const Network& network) {
  std::vector<std::size_t> count(network.nodes.size(), 0);
  for (const Element& element : network.elements) {
    ++count[element.a];
    ++count[element.b];
  }
  return count;
}

// Adds a note at a node whose name suggests that it was meant as `end`.
void note_what_end_is_called(const Network& network, NodeIndex end, const std::vector<Span>& node_places,
                             Diagnostics& diagnostics) {
  for (NodeIndex node = 0; node < network.nodes.size(); ++node)
    if (other_name_of_end(network.nodes[node]) == network.nodes[end])
      return diagnostics.note<DiagnosticCode::end_is_called>(node_places[node], network.nodes[end]);
}

// The nodes that elements join to `end`.
std::vector<std::string> nodes_joined_to(NodeIndex end, const Network& network, const DisjointSets& parts) {
  std::vector<std::string> names;
  for (NodeIndex node = 0; node < network.nodes.size(); ++node)
    if (node != end && parts.find(node) == parts.find(end)) names.push_back(network.nodes[node]);
  return names;
}

void check_ends(const Network& network, Span structure, const std::vector<Span>& node_places, const DisjointSets& parts,
                Diagnostics& diagnostics) {
  const std::vector<std::size_t> count = elements_at_nodes(network);
  for (const NodeIndex end : {tool, ground}) {
    if (count[end] > 0) continue;
    diagnostics.report<DiagnosticCode::end_unused>(structure, network.nodes[end]);
    note_what_end_is_called(network, end, node_places, diagnostics);
  }
  if (count[tool] == 0 || count[ground] == 0 || parts.find(tool) == parts.find(ground)) return;
  diagnostics.report<DiagnosticCode::ends_not_connected>(structure);
  const auto at_tool = nodes_joined_to(tool, network, parts), at_ground = nodes_joined_to(ground, network, parts);
  if (!at_tool.empty() && !at_ground.empty())
    diagnostics.note<DiagnosticCode::join_the_parts>({}, list_names(at_tool), list_names(at_ground));
}

void check_floating_parts(const Network& network, const DisjointSets& parts, Diagnostics& diagnostics) {
  std::vector<std::vector<const Element*>> members(network.nodes.size());
  for (const Element& element : network.elements)
    if (element.a != element.b) members[parts.find(element.a)].push_back(&element);
  members[parts.find(tool)].clear();
  members[parts.find(ground)].clear();
  for (const std::vector<const Element*>& part : members)
    if (!part.empty()) diagnostics.report<DiagnosticCode::floating_part>(part.front()->span, list_names(part));
}

void check_slip_paths(const Network& network, Diagnostics& diagnostics) {
  std::vector<bool> are_slips;
  for (const Element& element : network.elements) are_slips.push_back(is_slip(element.law));
  const std::vector<bool> on_path = on_path_between_ends(network, are_slips);
  std::vector<const Element*> slips;
  for (std::size_t i = 0; i < on_path.size(); ++i)
    if (on_path[i]) slips.push_back(&network.elements[i]);
  if (slips.empty()) return;
  diagnostics.report<DiagnosticCode::slips_join_ends>(slips.front()->span, list_names(slips));
  diagnostics.note<DiagnosticCode::add_presliding_spring>({});
}

// The node of `element` at which nothing else ends; `ground`, which is never one, if there is none.
NodeIndex loose_end(const Element& element, const std::vector<std::size_t>& count) {
  if (element.a != tool && element.a != ground && count[element.a] == 1) return element.a;
  return element.b != tool && element.b != ground && count[element.b] == 1 ? element.b : ground;
}

void warn_about_loose_end(const Network& network, const Element& element, NodeIndex end, Diagnostics& diagnostics) {
  diagnostics.report<DiagnosticCode::dangling_node>(element.span, network.nodes[end], element.name);
  if (const std::string_view meant = other_name_of_end(network.nodes[end]); !meant.empty()) {
    diagnostics.note<DiagnosticCode::end_is_called>({}, meant);
    return;
  }
  std::vector<std::string> others = network.nodes;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(end));
  if (const auto nearest = nearest_name(network.nodes[end], others))
    diagnostics.note<DiagnosticCode::nearest_name>({}, *nearest);
}

void warn_about(const Network& network, const Element& element, bool may_carry, NodeIndex end,
                Diagnostics& diagnostics) {
  if (!may_carry)
    diagnostics.report<DiagnosticCode::zero_value>(element.span, element.name,
                                                   unit_of(element.law, network.port_motion));
  else if (end != ground) warn_about_loose_end(network, element, end, diagnostics);
  else diagnostics.report<DiagnosticCode::no_effect>(element.span, element.name);
}

}  // namespace

void check_connections(const Network& network, Span structure, const std::vector<Span>& node_places,
                       Diagnostics& diagnostics) {
  const DisjointSets parts = connected_parts(network);
  check_ends(network, structure, node_places, parts, diagnostics);
  check_floating_parts(network, parts, diagnostics);
  check_slip_paths(network, diagnostics);
}

void mark_effect(Network& network, Diagnostics& diagnostics) {
  const std::vector<bool> may_carry = may_carry_force(network);
  const std::vector<bool> on_path = on_path_between_ends(network, may_carry);
  const std::vector<std::size_t> count = elements_at_nodes(network);
  for (std::size_t i = 0; i < network.elements.size(); ++i) {
    Element& element = network.elements[i];
    element.has_effect = on_path[i];
    if (!on_path[i]) warn_about(network, element, may_carry[i], loose_end(element, count), diagnostics);
  }
}

}  // namespace dashpot::compiler
