#include "linear/normal_form.hpp"

#include <algorithm>
#include <limits>

#include "linear/modal_reduction.hpp"
#include "network/effect.hpp"
#include "network/law.hpp"
#include "network/match.hpp"

namespace dashpot::compiler {
namespace {

NormalTree leaf(const Network& network, std::size_t index) {
  NormalTree part{NormalTree::Kind::block, {}, 0, {index}, {}};
  match(
      network.elements[index].law,
      [&](const Spring& spring) {
        part.form.static_stiffness = spring.stiffness;
        part.form.static_elements = {index};
      },
      [&](const Damper& damper) {
        part.form.feedthrough_damping = damper.damping;
        part.form.feedthrough_elements = {index};
      },
      [&](const Slip& slip) {
        part.kind = NormalTree::Kind::slip;
        part.yield_force = slip.yield_force;
      });
  return part;
}

void name_origins(LinearForm& form, const std::vector<std::size_t>& elements) {
  for (Mode& mode : form.modes) mode.elements = elements;
  if (form.static_stiffness > 0) form.static_elements = elements;
  if (form.feedthrough_damping > 0) form.feedthrough_elements = elements;
}

// In parallel the forms add up, in series their reciprocals.
NormalTree merged_blocks(NormalTree::Kind kind, const std::vector<NormalTree>& blocks) {
  if (blocks.size() == 1) return blocks.front();
  const bool in_series = kind == NormalTree::Kind::series;
  NormalTree all{NormalTree::Kind::block, {}, 0, {}, {}};
  for (const NormalTree& block : blocks) {
    unite(all.elements, block.elements);
    all.form = in_parallel(std::move(all.form), in_series ? reciprocal(block.form) : block.form);
  }
  if (in_series) {
    all.form = reciprocal(all.form);
    name_origins(all.form, all.elements);
  }
  return all;
}

// Slips in series yield at the least of their forces, in parallel at the sum.
NormalTree merged_slips(NormalTree::Kind kind, const std::vector<NormalTree>& slips) {
  NormalTree all{NormalTree::Kind::slip, {}, 0, {}, {}};
  if (kind == NormalTree::Kind::series) all.yield_force = std::numeric_limits<Real>::infinity();
  for (const NormalTree& slip : slips) {
    all.yield_force = kind == NormalTree::Kind::series ? std::min(all.yield_force, slip.yield_force)
                                                       : Real(all.yield_force + slip.yield_force);
    unite(all.elements, slip.elements);
  }
  return all;
}

NormalTree normal(const Tree& tree, const Network& network) {
  if (tree.kind == Tree::Kind::leaf) return leaf(network, tree.element);
  const auto kind = tree.kind == Tree::Kind::series ? NormalTree::Kind::series : NormalTree::Kind::parallel;
  std::vector<NormalTree> blocks, slips, rest;
  for (const Tree& child : tree.children) {
    NormalTree part = normal(child, network);
    auto& group = part.kind == NormalTree::Kind::block ? blocks : part.kind == NormalTree::Kind::slip ? slips : rest;
    group.push_back(std::move(part));
  }
  NormalTree result{kind, {}, 0, {}, {}};
  if (!blocks.empty()) result.children.push_back(merged_blocks(kind, blocks));
  if (!slips.empty()) result.children.push_back(merged_slips(kind, slips));
  for (NormalTree& part : rest) result.children.push_back(std::move(part));
  if (result.children.size() == 1) return std::move(result.children.front());
  return result;
}

bool has_slips(const Network& network, const std::vector<std::size_t>& elements) {
  return std::any_of(elements.begin(), elements.end(),
                     [&](std::size_t element) { return is_slip(network.elements[element].law); });
}

// How the surface of a contact moves depends on all that is behind it, so that all slips are solved together.
void join_behind_surface(NormalForm& form) {
  std::vector<std::size_t> together;
  for (const NormalTree& component : form.components)
    for (std::size_t element : elements_of(component)) together.push_back(element);
  for (const std::vector<std::size_t>& part : form.networks) together.insert(together.end(), part.begin(), part.end());
  form.components.clear();
  form.networks = {std::move(together)};
}

// Of a network that is no tree: parts that share no inner node are each linear, a tree, or neither.
NormalForm form_by_parts(const Network& network) {
  NormalForm form;
  std::vector<std::size_t> linear;
  for (Part& part : independent_parts(network, effective_elements(network), tool, ground)) {
    if (!has_slips(network, part.elements)) linear.insert(linear.end(), part.elements.begin(), part.elements.end());
    else if (const std::optional<Tree> tree = series_parallel_tree(with_effect_of(part.elements, network)))
      form.components.push_back(normal(*tree, network));
    else form.networks.push_back(std::move(part.elements));
  }
  std::sort(linear.begin(), linear.end());
  form.linear = linear_form(network, linear, tool, ground);
  if (network.contact && !form.networks.empty()) join_behind_surface(form);
  return form;
}

void mark_without_effect(const NormalTree& tree, Network& network) {
  for (std::size_t element : tree.elements) network.elements[element].has_effect = false;
  for (const NormalTree& child : tree.children) mark_without_effect(child, network);
}

}  // namespace

NormalForm normal_form(const Network& network) {
  if (!has_slips(network, effective_elements(network))) return {linear_form(network), {}, {}};
  const std::optional<Tree> tree = series_parallel_tree(network);
  if (!tree) return form_by_parts(network);
  NormalTree root = normal(*tree, network);
  NormalForm form;
  if (root.kind != NormalTree::Kind::parallel) {
    form.components.push_back(std::move(root));
    return form;
  }
  for (NormalTree& child : root.children) {
    if (child.kind == NormalTree::Kind::block) form.linear = std::move(child.form);
    else form.components.push_back(std::move(child));
  }
  return form;
}

Network linear_part(const Network& network, const NormalForm& form) {
  Network linear = network;
  for (const NormalTree& component : form.components) mark_without_effect(component, linear);
  for (const std::vector<std::size_t>& elements : form.networks)
    for (std::size_t element : elements) linear.elements[element].has_effect = false;
  return linear;
}

NormalTree whole_tree(const NormalForm& form, const Network& network) {
  NormalTree block{NormalTree::Kind::block, form.linear, 0, effective_elements(linear_part(network, form)), {}};
  if (block.elements.empty() && form.components.size() == 1) return form.components.front();
  NormalTree whole{NormalTree::Kind::parallel, {}, 0, {}, {}};
  if (!block.elements.empty()) whole.children.push_back(std::move(block));
  whole.children.insert(whole.children.end(), form.components.begin(), form.components.end());
  return whole.children.size() == 1 ? whole.children.front() : whole;
}

std::map<std::pair<NodeIndex, NodeIndex>, Real> slips_between(const Network& network,
                                                              const std::vector<std::size_t>& elements) {
  std::map<std::pair<NodeIndex, NodeIndex>, Real> slips;
  for (std::size_t index : elements) {
    const Element& element = network.elements[index];
    if (is_slip(element.law)) slips[std::minmax(element.a, element.b)] += yield_force_of(element.law);
  }
  return slips;
}

std::vector<std::vector<std::size_t>> slips_together(const Network& network, const std::vector<std::size_t>& elements) {
  std::map<std::pair<NodeIndex, NodeIndex>, std::vector<std::size_t>> between;
  for (std::size_t index : elements) {
    const Element& element = network.elements[index];
    if (is_slip(element.law)) between[std::minmax(element.a, element.b)].push_back(index);
  }
  std::vector<std::vector<std::size_t>> slips;
  for (auto& [ends, together] : between) slips.push_back(std::move(together));
  return slips;
}

std::size_t slip_count(const NormalTree& tree) {
  std::size_t count = tree.kind == NormalTree::Kind::slip ? 1 : 0;
  for (const NormalTree& child : tree.children) count += slip_count(child);
  return count;
}

std::vector<const NormalTree*> slips_of(const NormalTree& tree) {
  std::vector<const NormalTree*> parts{&tree}, slips;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const NormalTree& part = *parts[i];
    if (part.kind == NormalTree::Kind::slip) slips.push_back(&part);
    for (const NormalTree& child : part.children) parts.push_back(&child);
  }
  return slips;
}

std::vector<std::size_t> elements_of(const NormalTree& tree) {
  std::vector<std::size_t> elements = tree.elements;
  for (const NormalTree& child : tree.children) unite(elements, elements_of(child));
  return elements;
}

}  // namespace dashpot::compiler
