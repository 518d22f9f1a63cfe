#include "discretise/slip_parts.hpp"

#include <algorithm>

#include "discretise/element_names.hpp"

namespace dashpot::compiler {
namespace {

// All that is behind a contact as one tree, each component as the law computes it.
NormalTree rendered_whole(const NormalForm& form, const Network& network, const SlipDecomposition& settings) {
  NormalTree whole = whole_tree(form, network);
  if (settings.components.size() != form.components.size()) return whole;
  if (whole.kind != NormalTree::Kind::parallel) return settings.components.front().rendered;
  const std::size_t first = whole.children.size() - form.components.size();
  for (std::size_t i = 0; i < form.components.size(); ++i) whole.children[first + i] = settings.components[i].rendered;
  return whole;
}

}  // namespace

SlipParts::SlipParts(LawWriter& writer, const Network& network, const Real& sample_period, const NormalForm& form,
                     const SlipDecomposition& settings)
    : writer_(writer), network_(network), sample_period_(sample_period), settings_(settings) {
  if (network.contact && !form.components.empty()) {
    add_behind_contact(form);
    return;
  }
  for (std::size_t i = 0; i < form.components.size(); ++i) {
    const ComponentSplit* split = i < settings_.components.size() ? &settings_.components[i] : nullptr;
    add(split ? split->rendered : form.components[i], split);
  }
  for (std::size_t i = 0; i < form.networks.size(); ++i) {
    const bool is_split = i < settings_.networks.size();
    add(is_split ? settings_.networks[i].rendered_elements : form.networks[i], network.contact.has_value());
    if (is_split) add_brake(settings_.networks[i], nullptr);
  }
}

void SlipParts::add(const NormalTree& component, const ComponentSplit* split) {
  if (slip_count(component) > 1) {
    trees_.push_back(std::make_unique<CoupledSlips>(writer_, network_, sample_period_, component));
    if (split != nullptr) add_brake(*split, trees_.back().get());
    return;
  }
  const auto fitting =
      std::find_if(groups_.begin(), groups_.end(), [&](const auto& group) { return group->accepts(component, split); });
  if (fitting != groups_.end()) return (*fitting)->add(component, split);
  groups_.push_back(std::make_unique<SlipGroup>(writer_, network_, sample_period_, settings_));
  groups_.back()->add(component, split);
}

void SlipParts::add(const std::vector<std::size_t>& elements, bool is_pushed) {
  networks_.push_back(std::make_unique<NetworkedSlips>(writer_, network_, sample_period_, elements, is_pushed));
}

// How the surface moves depends on all that is behind it, so that is one tree, in which the states of the linear part
// at the tool are the same as without slips.
void SlipParts::add_behind_contact(const NormalForm& form) {
  whole_ = rendered_whole(form, network_, settings_);
  const bool has_linear =
      whole_.children.front().kind == NormalTree::Kind::block && whole_.kind == NormalTree::Kind::parallel;
  trees_.push_back(std::make_unique<CoupledSlips>(writer_, network_, sample_period_, whole_));
  if (has_linear) trees_.back()->keep_elsewhere(whole_.children.front());
  for (const ComponentSplit& split : settings_.components) add_brake(split, trees_.front().get());
}

void SlipParts::add_brake(const ComponentSplit& split, CoupledSlips* tree) {
  auto brake = std::make_unique<SlipBrake>(writer_, settings_);
  brake->add(&split);
  if (!brake->takes_part()) return;
  if (tree != nullptr && brake->changes()) tree->follow_signs();
  braked_.push_back({std::move(brake), tree, tree == nullptr ? networks_.back().get() : nullptr, {}});
}

double SlipParts::smallest_loss() const {
  double smallest = 1;
  for (const auto& group : groups_) smallest = std::min(smallest, group->smallest_loss());
  for (const auto& tree : trees_) smallest = std::min(smallest, tree->smallest_loss());
  for (const auto& network : networks_) smallest = std::min(smallest, network->smallest_loss());
  return smallest;
}

void SlipParts::declare() {
  for (const auto& group : groups_) group->declare();
  for (const auto& tree : trees_) tree->declare();
  for (const auto& network : networks_) network->declare();
  for (Braked& part : braked_) declare(part);
}

void SlipParts::declare(Braked& part) {
  Names names;
  for (const SlipElements& slip : part.brake->slips()) {
    names.push_back(writer_.unique(joined(name_of(slip, network_), "brake")));
    if (part.brake->changes()) part.signs.push_back(part.tree ? part.tree->sign_of(slip) : part.network->sign_of(slip));
  }
  part.brake->declare(names.front(), {names.front()}, names);
}

ExpressionId SlipParts::write_output(ExpressionId sum, VariableId change, VariableId position) {
  for (const auto& group : groups_) sum = writer_.plus(sum, group->write_output(change, position));
  for (const auto& tree : trees_) sum = writer_.plus(sum, tree->write_output(change));
  for (const auto& network : networks_) sum = writer_.plus(sum, network->write_output(change));
  return sum;
}

ExpressionId SlipParts::write_push(VariableId approach, VariableId surface_change, const BesideSlips& beside) {
  if (!networks_.empty()) return networks_.front()->write_push(approach, surface_change, beside);
  trees_.front()->set_held_elsewhere(beside.held);
  return trees_.front()->write_output(approach, surface_change);
}

void SlipParts::write_update(VariableId change) {
  for (const auto& group : groups_) group->write_update(change);
  for (const auto& tree : trees_) tree->write_update();
  for (const auto& network : networks_) network->write_update();
}

ExpressionId SlipParts::energy(ExpressionId sum) {
  for (const auto& group : groups_) sum = writer_.plus(sum, group->energy());
  for (const auto& tree : trees_) sum = writer_.plus(sum, tree->energy());
  for (const auto& network : networks_) sum = writer_.plus(sum, network->energy());
  return sum;
}

}  // namespace dashpot::compiler
