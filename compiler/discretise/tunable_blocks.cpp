#include "discretise/tunable_blocks.hpp"

#include <algorithm>
#include <map>

#include "discretise/element_names.hpp"
#include "discretise/law_writer.hpp"
#include "discretise/mode_coefficients.hpp"
#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

bool is_tunable(const Network& network, std::size_t element) {
  return network.tunable_of(network.elements[element]) != nullptr;
}

std::optional<Tree> restricted(const Tree& tree, const std::vector<std::size_t>& elements) {
  if (tree.kind == Tree::Kind::leaf) {
    const bool is_in = std::find(elements.begin(), elements.end(), tree.element) != elements.end();
    return is_in ? std::optional(tree) : std::nullopt;
  }
  Tree rest{tree.kind, 0, {}};
  for (const Tree& child : tree.children)
    if (std::optional<Tree> part = restricted(child, elements)) rest.children.push_back(std::move(*part));
  if (rest.children.empty()) return std::nullopt;
  if (rest.children.size() == 1) return std::move(rest.children.front());
  return rest;
}

void lay_out(const Tree& tree, NodeIndex from, NodeIndex to, Network& network) {
  if (tree.kind == Tree::Kind::leaf) {
    network.elements[tree.element].a = from;
    network.elements[tree.element].b = to;
    network.elements[tree.element].has_effect = true;
  }
  NodeIndex here = from;
  for (const Tree& child : tree.children) {
    NodeIndex next = to;
    if (tree.kind == Tree::Kind::series && &child != &tree.children.back()) {
      next = network.nodes.size();
      network.nodes.push_back("inner");
    }
    lay_out(child, here, next, network);
    if (tree.kind == Tree::Kind::series) here = next;
  }
}

std::vector<std::vector<std::size_t>> cuts_of(const Tree& tree) {
  if (tree.kind == Tree::Kind::leaf) return {{tree.element}};
  std::vector<std::vector<std::size_t>> all;
  if (tree.kind == Tree::Kind::series) {
    for (const Tree& child : tree.children)
      for (std::vector<std::size_t>& cut : cuts_of(child)) all.push_back(std::move(cut));
    return all;
  }
  all.push_back({});
  for (const Tree& child : tree.children) {
    std::vector<std::vector<std::size_t>> joined;
    for (const std::vector<std::size_t>& cut : all)
      for (const std::vector<std::size_t>& more : cuts_of(child)) {
        joined.push_back(cut);
        joined.back().insert(joined.back().end(), more.begin(), more.end());
      }
    all = std::move(joined);
  }
  return all;
}

struct Sides {
  std::vector<std::size_t> springs_at_port, dampers_at_port, springs_at_held, dampers_at_held;
};

Sides sides_of(const Network& network, const Part& part) {
  Sides sides;
  for (std::size_t i : part.elements) {
    const Element& e = network.elements[i];
    const bool at_port = e.a == part.port || e.b == part.port;
    auto& side = is_spring(e.law) ? (at_port ? sides.springs_at_port : sides.springs_at_held)
                                  : (at_port ? sides.dampers_at_port : sides.dampers_at_held);
    side.push_back(i);
  }
  return sides;
}

}  // namespace

TunableBlocks::TunableBlocks(const Network& network, const Choices& choices, const Real& sample_period,
                             TunableTables& tables)
    : whole_(network), choices_(choices), sample_period_(sample_period), tables_(tables) {
  std::size_t next = 0;
  for (const Parameter& parameter : network.parameters)
    tunable_of_parameter_.push_back(parameter.tunable ? next++ : next);
}

void TunableBlocks::add(const Network& network, const std::vector<std::size_t>& elements, bool is_loose) {
  tables_.blocks.push_back({static_cast<int>(tables_.parts.size()), 0, 0});
  tables_.block_names.push_back(elements.empty() ? "direct" : name_of(elements, whole_));
  tables_.block_elements.push_back(elements);
  std::vector<std::size_t> fixed_elements, direct;
  std::vector<Part> others;
  for (Part& part : independent_parts(network, elements, tool, ground)) {
    const bool is_fixed =
        std::none_of(part.elements.begin(), part.elements.end(), [&](std::size_t i) { return is_tunable(network, i); });
    auto* list = is_fixed ? &fixed_elements : part.internal.empty() ? &direct : nullptr;
    if (list != nullptr) list->insert(list->end(), part.elements.begin(), part.elements.end());
    else others.push_back(std::move(part));
  }
  const LinearForm fixed = linear_form(network, fixed_elements, tool, ground);
  add_direct(network, direct, fixed, is_loose);
  add_fixed(network, fixed);
  for (const Part& part : others)
    if (!add_relaxation(network, part)) add_mesh(network, part);
  tables_.blocks.back().part_count = static_cast<int>(tables_.parts.size()) - tables_.blocks.back().first_part;
}

int TunableBlocks::number(const Network& network, const std::vector<std::size_t>& elements, NumberSubject of,
                          const Real& base, std::vector<std::size_t> named) {
  Real sum = base;
  std::vector<TunableTerm> terms;
  for (std::size_t i : elements) {
    const Element& element = network.elements[i];
    if (!is_tunable(network, i)) sum += value_of(element.law);
    else terms.push_back({tunable_of_parameter_[*element.parameter], rounded(Real(element.share), choices_.scalar), i});
  }
  named.insert(named.begin(), elements.begin(), elements.end());
  const Element& one = whole_.elements[named.empty() ? 0 : named.front()];
  tables_.numbers.push_back({rounded(sum, choices_.scalar), std::move(terms),
                             named.empty() ? "none" : name_of(named, whole_), unit_of(one.law, whole_.port_motion),
                             std::move(of)});
  return static_cast<int>(tables_.numbers.size()) - 1;
}

int TunableBlocks::add_spring(int stiffness, std::string name, std::optional<FixedRelaxation> fixed) {
  tables_.springs.push_back(stiffness);
  tables_.fixed.push_back(fixed);
  tables_.spring_names.push_back(std::move(name));
  return static_cast<int>(tables_.springs.size()) - 1;
}

// k0 and b∞: those of the fixed parts and what tunables add.
void TunableBlocks::add_direct(const Network& network, const std::vector<std::size_t>& elements,
                               const LinearForm& fixed, bool is_loose) {
  std::vector<std::size_t> springs, dampers;
  for (std::size_t i : elements) (is_spring(network.elements[i].law) ? springs : dampers).push_back(i);
  if (!springs.empty() || fixed.static_stiffness > 0) {
    std::vector<std::size_t> named = springs;
    named.insert(named.end(), fixed.static_elements.begin(), fixed.static_elements.end());
    const int spring = add_spring(number(network, springs, {NumberKind::block_stiffness, tables_.block_elements.back()},
                                         fixed.static_stiffness, fixed.static_elements),
                                  name_of(named, whole_));
    tables_.parts.push_back({PartKind::spring, spring, no_index, no_index, no_index, 0, 0, 0, 0, is_loose});
    if (tables_.blocks.size() == 1) tables_.head.static_spring = spring;
  }
  if (!dampers.empty() || fixed.feedthrough_damping > 0)
    tables_.parts.push_back({PartKind::damper, no_index,
                             number(network, dampers, {NumberKind::block_damping, tables_.block_elements.back()},
                                    fixed.feedthrough_damping, fixed.feedthrough_elements),
                             no_index, no_index, 0, 0, 0, 0, false});
}

void TunableBlocks::add_fixed(const Network& network, const LinearForm& fixed) {
  for (const Mode& mode : fixed.modes) {
    const auto place = static_cast<std::size_t>(&mode - fixed.modes.data());
    const ElementList& elements = tables_.block_elements.back();
    const ModeCoefficients c = mode_coefficients(mode, choices_.scheme, StateInput::position, sample_period_);
    const FixedRelaxation kept = {rounded(c.position_gain / mode.stiffness, choices_.scalar),
                                  rounded(c.loss, choices_.scalar)};
    const int stiffness =
        number(network, {}, {NumberKind::mode_stiffness, elements, place}, mode.stiffness, mode.elements);
    const int damping = number(network, {}, {NumberKind::mode_damping, elements, place}, mode.damping(), mode.elements);
    const auto describe = [&](int index, const char* what, const Law& law) {
      TunableNumber& described = tables_.numbers[static_cast<std::size_t>(index)];
      described.name = joined(described.name, what);
      described.unit = unit_of(law, whole_.port_motion);
    };
    describe(stiffness, "stiffness", Spring{});
    describe(damping, "damping", Damper{});
    const int spring = add_spring(stiffness, name_of(mode.elements, whole_), kept);
    tables_.parts.push_back({PartKind::relaxation, spring, damping, no_index, no_index, 0, 0, 0, 0, false});
  }
}

// If the part has one inner node, springs on one side of it and dampers on the other.
bool TunableBlocks::add_relaxation(const Network& network, const Part& part) {
  if (part.internal.size() != 1) return false;
  const Sides sides = sides_of(network, part);
  const bool spring_first = sides.dampers_at_port.empty() && sides.springs_at_held.empty();
  const bool damper_first = sides.springs_at_port.empty() && sides.dampers_at_held.empty();
  if (!spring_first && !damper_first) return false;
  const int stiffness = number(network, spring_first ? sides.springs_at_port : sides.springs_at_held);
  const int spring = add_spring(stiffness, name_of(part.elements, whole_));
  const int damping = number(network, spring_first ? sides.dampers_at_held : sides.dampers_at_port);
  tables_.parts.push_back({PartKind::relaxation, spring, damping, no_index, no_index, 0, 0, 0, 0, false});
  return true;
}

// Elements of one kind between the same nodes are one edge.
void TunableBlocks::add_mesh(const Network& network, const Part& part) {
  std::map<NodeIndex, int> place = {{part.port, mesh_port}, {part.held, mesh_held}};
  for (NodeIndex node : part.internal) place.emplace(node, static_cast<int>(place.size()) - 2);
  std::map<std::pair<std::pair<int, int>, bool>, std::vector<std::size_t>> edges;
  for (std::size_t i : part.elements) {
    const Element& e = network.elements[i];
    const int a = place.at(e.a), b = place.at(e.b);
    const bool forwards = a == mesh_port || b == mesh_held || (a >= 0 && b >= 0 && a < b);
    edges[{forwards ? std::pair(a, b) : std::pair(b, a), is_spring(e.law)}].push_back(i);
    tables_.mesh_elements.push_back(e.name);
  }
  const int first_edge = static_cast<int>(tables_.edges.size());
  for (const auto& [between, elements] : edges) {
    const int value = number(network, elements);
    const bool is_elastic = between.second;
    const int spring = is_elastic ? add_spring(value, name_of(elements, whole_)) : no_index;
    tables_.edges.push_back({between.first.first, between.first.second, spring, is_elastic ? no_index : value});
  }
  const int nodes = static_cast<int>(part.internal.size());
  tables_.parts.push_back({PartKind::mesh, no_index, no_index, no_index, no_index, tables_.mesh_nodes, nodes,
                           first_edge, static_cast<int>(tables_.edges.size()) - first_edge, false});
  tables_.mesh_nodes += nodes;
}

Network laid_out_part(const Network& network, const Tree& tree, const std::vector<std::size_t>& elements) {
  Network part = network;
  part.nodes.resize(2);
  for (Element& element : part.elements) element.has_effect = false;
  if (const std::optional<Tree> branches = restricted(tree, elements)) lay_out(*branches, tool, ground, part);
  return part;
}

std::vector<std::vector<std::size_t>> cuts_through(const Tree& tree, const std::vector<std::size_t>& slips) {
  const std::optional<Tree> branches = restricted(tree, slips);
  return branches ? cuts_of(*branches) : std::vector<std::vector<std::size_t>>{};
}

}  // namespace dashpot::compiler
