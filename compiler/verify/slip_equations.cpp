#include "verify/slip_equations.hpp"

#include <algorithm>
#include <limits>

namespace dashpot::compiler {
namespace {

using Values = SlipEquations::Values;

bool is_empty(const ReferenceForm& f) {
  return f.static_stiffness == 0 && f.feedthrough_damping == 0 && f.modes.empty();
}

// All that is behind a contact as one tree.
ReferencePart whole_of(const ReferenceTree& tree) {
  ReferencePart whole{ReferenceKind::parallel, {}, {}, 0, tree.components};
  if (!is_empty(tree.linear))
    whole.children.insert(whole.children.begin(), {ReferenceKind::block, {}, tree.linear, 0, {}});
  if (whole.children.size() != 1) return whole;
  return ReferencePart(std::move(whole.children.front()));
}

ReferenceMode plain(const ReferenceNetworkMode& mode) { return {mode.stiffness, mode.relaxation_rate, 1}; }

std::optional<std::size_t> end_of(const ReferenceNetwork& form, NodeIndex node) {
  const auto place = std::find(form.ends.begin(), form.ends.end(), node);
  if (place == form.ends.end()) return std::nullopt;
  return std::size_t(place - form.ends.begin());
}

bool is_pushed(const SlipNetwork& table) {
  return std::find(table.end_nodes.begin(), table.end_nodes.end(), tool) != table.end_nodes.end();
}

// Depth first, as feedthrough_in() counts them.
void collect_slips(const ReferencePart& part, std::vector<ElementList>& slips) {
  if (part.kind == ReferenceKind::slip) slips.push_back(sorted(elements_of(part)));
  for (const ReferencePart& child : part.children) collect_slips(child, slips);
}

}  // namespace

SlipEquations::SlipEquations(const ReferenceTree& tree, ReferenceForm linear, const Network& network,
                             const SlipDecomposition& slips, const LawFacts& facts)
    : tree_(tree),
      linear_(std::move(linear)),
      network_(network),
      slips_(slips),
      facts_(facts),
      whole_(reference_constants(linear_, facts)),
      behind_surface_{ReferenceKind::parallel, {}, {}, 0, {}} {
  for (const ElementList& part : tree.networks) networks_.push_back({sorted(part), reference_network(network, part)});
  if (network.contact && !tree.components.empty()) {
    behind_surface_ = whole_of(tree);
    index(behind_surface_);
    return;
  }
  for (std::size_t i = 0; i < tree.components.size(); ++i) {
    index(tree.components[i]);
    if (slip_count(tree.components[i]) == 1)
      add_rows(tree.components[i], i < slips.components.size() ? &slips.components[i].shares : nullptr);
  }
}

// Every part by its elements. A block without any of its own is all that reaches ground without a slip.
ElementList SlipEquations::index(const ReferencePart& part) {
  const bool is_linear = !behind_surface_.children.empty() && &part == &behind_surface_.children.front() &&
                         part.kind == ReferenceKind::block && !is_empty(tree_.linear);
  ElementList all;
  if (is_linear) all = effective_elements(tree_.linear_network);
  else if (part.children.empty()) all = elements_of(part);
  for (const ReferencePart& child : part.children) {
    const ElementList of_child = index(child);
    all.insert(all.end(), of_child.begin(), of_child.end());
  }
  all = sorted(std::move(all));
  parts_[all] = &part;
  return all;
}

void SlipEquations::add_rows(const ReferencePart& component, const std::vector<BrakeShare>* shares) {
  KnownRows known{{}, {}, blocks_of(component), {}, shares};
  std::vector<Reference> stiffness_of_blocks;
  for (const ReferencePart* block : known.parts) {
    known.blocks.push_back(sorted(elements_of(*block)));
    stiffness_of_blocks.push_back(companion(block->form, facts_));
  }
  std::vector<ElementList> slips;
  collect_slips(component, slips);
  known.slip = slips.front();
  known.rows = slip_rows(component, stiffness_of_blocks);
  rows_.push_back(std::move(known));
}

const ReferencePart* SlipEquations::part(const ElementList& elements) const {
  const auto found = parts_.find(sorted(elements));
  return found == parts_.end() ? nullptr : found->second;
}

const ReferenceNetwork* SlipEquations::network(const ElementList& elements) const {
  const ElementList wanted = sorted(elements);
  const auto found = std::find_if(networks_.begin(), networks_.end(),
                                  [&](const KnownNetwork& known) { return known.elements == wanted; });
  return found == networks_.end() ? nullptr : &found->form;
}

const ReferenceNetworkMode* SlipEquations::mode(const OfPartMode& of) const {
  const ReferenceNetwork* form = network(of.part);
  if (form == nullptr) return nullptr;
  const ElementList wanted = sorted(of.elements);
  std::size_t place = 0;
  for (const ReferenceNetworkMode& known : form->modes)
    if (known.elements == wanted && place++ == of.mode) return &known;
  return nullptr;
}

// Over one sample, with every slip giving way.
Reference SlipEquations::stiffness(const ReferencePart& part) const {
  if (part.kind == ReferenceKind::block) return companion(part.form, facts_);
  Reference sum = 0, compliance = 0;
  bool is_flat = part.children.empty();
  for (const ReferencePart& child : part.children) {
    const Reference g = stiffness(child);
    is_flat = is_flat || (part.kind == ReferenceKind::series && g == 0);
    sum += g;
    if (g > 0) compliance += 1 / g;
  }
  if (is_flat) return 0;
  return part.kind == ReferenceKind::series ? Reference(1 / compliance) : sum;
}

std::optional<Reference> SlipEquations::value(const Coefficient& constant, std::size_t place) const {
  if (constant.of.empty()) return of_whole(constant, place);
  const Subject& subject = constant.of.size() == 1 ? constant.of.front() : constant.of[place];
  switch (constant.role) {
    case ConstantRole::decay:
    case ConstantRole::loss:
    case ConstantRole::gain:
    case ConstantRole::energy_weight: return of_mode(constant.role, subject, place);
    case ConstantRole::spring_stiffness: return spring(subject);
    case ConstantRole::spring_compliance:
      if (const auto k = spring(subject); k && *k > 0) return 1 / (2 * *k);
      return std::nullopt;
    case ConstantRole::row:
      return std::holds_alternative<OfRow>(subject) ? row(std::get<OfRow>(subject)) : std::nullopt;
    case ConstantRole::yield:
      if (const auto* of = std::get_if<OfElements>(&subject))
        if (const ReferencePart* slip = part(of->elements); slip != nullptr && slip->kind == ReferenceKind::slip)
          return slip->yield_force;
      return std::nullopt;
    case ConstantRole::mode_weight:
      if (const auto* of = std::get_if<OfPartMode>(&subject))
        if (const ReferenceNetworkMode* found = mode(*of))
          if (const auto end = end_of(*network(of->part), of->node)) return found->weights[*end];
      return std::nullopt;
    case ConstantRole::regime_feedthrough:
      return std::holds_alternative<OfRegime>(subject) ? regime_feedthrough(std::get<OfRegime>(subject)) : std::nullopt;
    default: return std::nullopt;
  }
}

std::optional<Reference> SlipEquations::of_whole(const Coefficient& constant, std::size_t place) const {
  const auto kind = [&](const char* name) -> std::optional<Reference> {
    const auto found = whole_.find(name);
    if (found == whole_.end() || place >= found->second.size()) return std::nullopt;
    return found->second[place];
  };
  switch (constant.role) {
    case ConstantRole::static_stiffness: return kind("static_stiffness");
    case ConstantRole::half_static_stiffness: return kind("half_static_stiffness");
    case ConstantRole::step_stiffness: return kind("step_stiffness");
    case ConstantRole::velocity_gain: return kind("velocity_gain");
    case ConstantRole::decay: return kind("decay");
    case ConstantRole::loss: return kind("loss");
    case ConstantRole::gain: return kind("gain");
    case ConstantRole::velocity_drive: return kind("velocity_drive");
    case ConstantRole::energy_weight: return kind("energy_weight");
    case ConstantRole::feedthrough: return linear_.feedthrough_damping;
    case ConstantRole::feedthrough_stiffness: return -linear_.feedthrough_damping * Reference(facts_.rate);
    case ConstantRole::recovery_compliance: {
      const Reference g = companion(linear_, facts_);
      return g == 0 ? Reference(0) : Reference(-1 / g);
    }
    case ConstantRole::surface_place: return Reference(network_.surface_behind_map());
    case ConstantRole::zero: return Reference(0);
    default: return std::nullopt;
  }
}

std::optional<Reference> SlipEquations::of_mode(ConstantRole role, const Subject& subject, std::size_t place) const {
  std::optional<ReferenceMode> one;
  if (const auto* of = std::get_if<OfElements>(&subject))
    if (const ReferencePart* block = part(of->elements); block != nullptr && place < block->form.modes.size())
      one = block->form.modes[place];
  if (const auto* of = std::get_if<OfPartMode>(&subject))
    if (const ReferenceNetworkMode* found = mode(*of)) one = plain(*found);
  if (!one) return std::nullopt;
  const ModeFactors f = mode_factors(*one, facts_);
  if (role == ConstantRole::decay) return f.decay;
  if (role == ConstantRole::loss) return f.loss;
  if (role == ConstantRole::gain) return f.decay * f.gain;
  return energy_weight(*one, f, facts_.scalar);
}

std::optional<Reference> SlipEquations::spring(const Subject& subject) const {
  if (const auto* of = std::get_if<OfElements>(&subject))
    if (const ReferencePart* block = part(of->elements); block != nullptr && block->kind == ReferenceKind::block)
      return block->form.static_stiffness;
  if (const auto* of = std::get_if<OfTie>(&subject))
    if (const ReferenceNetwork* form = network(of->part)) {
      const auto first = end_of(*form, of->first), second = end_of(*form, of->second);
      if (first && second) return form->springs[*first][*second];
    }
  return std::nullopt;
}

std::optional<Reference> SlipEquations::row(const OfRow& of) const {
  const auto known =
      std::find_if(rows_.begin(), rows_.end(), [&](const KnownRows& k) { return k.slip == sorted(of.slip); });
  if (known == rows_.end()) return std::nullopt;
  const auto place = [&](const ElementList& block) {
    return std::size_t(std::find(known->blocks.begin(), known->blocks.end(), sorted(block)) - known->blocks.begin());
  };
  const std::size_t block = place(of.block), held = place(of.held), blocks = known->blocks.size();
  const bool is_of_block = of.quantity == RowOf::elongation || of.quantity == RowOf::spring;
  const bool is_held = of.factor == RowFor::held;
  if ((is_of_block && block == blocks) || (is_held && held == blocks)) return std::nullopt;
  const ReferenceRow& row = of.quantity == RowOf::trial ? known->rows.trial
                            : is_of_block               ? known->rows.elongation[block]
                                                        : known->rows.force;
  Reference value = is_held ? row.held[held] : of.factor == RowFor::change ? row.change : row.excess;
  if (of.quantity == RowOf::spring) {
    const ReferenceForm& form = known->parts[block]->form;
    value *= form.static_stiffness;
    if (is_held && held == block && form.modes.empty()) value += 1;
  }
  const bool is_force = of.quantity == RowOf::force || of.quantity == RowOf::stuck_force;
  if (is_force && of.factor == RowFor::change && known->shares != nullptr) {
    const BrakeShare& share = of.quantity == RowOf::force ? known->shares->back() : known->shares->front();
    value -= Reference(share.feedthrough) * Reference(facts_.rate);
  }
  return of.is_subtracted ? Reference(-value) : value;
}

// b∞ of a regime; empty where it is rigid, or the network has no such slips.
std::optional<Reference> SlipEquations::feedthrough_of(const OfRegime& of, std::size_t regime) const {
  const ElementList first = sorted(of.slips.front());
  for (const auto& [elements, form] : networks_) {
    if (!std::includes(elements.begin(), elements.end(), first.begin(), first.end())) continue;
    std::vector<bool> slides;
    for (std::size_t i = 0; i < of.slips.size(); ++i)
      slides.push_back(regime == every_slip_slides || (regime >> i & 1u) != 0);
    return reference_form(network_in_regime(network_, elements, of.slips, slides)).feedthrough_damping;
  }
  for (const ReferencePart& component : tree_.components) {
    std::vector<ElementList> slips;
    collect_slips(component, slips);
    const bool all_slide = regime == every_slip_slides;
    std::size_t pattern = all_slide ? regime : 0, found = 0;
    for (std::size_t i = 0; i < slips.size(); ++i)
      for (std::size_t j = 0; j < of.slips.size(); ++j)
        if (slips[i] == sorted(of.slips[j])) pattern |= all_slide ? 0 : (regime >> j & 1u) << i, ++found;
    if (found == slips.size()) return feedthrough_in(component, pattern);
  }
  return std::nullopt;
}

// x/h: b∞ of the regime, or, where no more than a part of it was left for the brake, that part. Where all regimes are
// alike the least of their b∞.
std::optional<Reference> SlipEquations::regime_feedthrough(const OfRegime& of) const {
  const std::vector<const ComponentSplit*> splits = slips_.all();
  const auto split =
      std::find_if(splits.begin(), splits.end(), [&](const ComponentSplit* s) { return s->regimes.slips == of.slips; });
  if (split == splits.end()) return std::nullopt;
  const std::vector<Regime>& listed = (*split)->regimes.regimes;
  const std::size_t first = of.regime ? *of.regime : listed.empty() ? every_slip_slides : 0;
  const std::size_t count = of.regime || listed.empty() ? 1 : listed.size();
  const Real& share = (*split)->shares.at(of.regime.value_or(0)).feedthrough;
  std::optional<Reference> most;
  bool is_a_part = false;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t regime = first + i;
    const std::optional<Reference> here = feedthrough_of(of, regime);
    if (here) most = most ? std::min(*most, *here) : *here;
    is_a_part = is_a_part || (regime < listed.size() && share < listed[regime].feedthrough());
  }
  if (most && (!is_a_part || Reference(share) > *most)) return *most * Reference(facts_.rate);
  return Reference(share) * Reference(facts_.rate);
}

bool SlipEquations::are_shares_within_regimes() const {
  for (const ComponentSplit* split : slips_.all())
    for (std::size_t regime = 0; regime < split->regimes.regimes.size(); ++regime) {
      const std::optional<Reference> most = feedthrough_of({split->regimes.slips, {}}, regime);
      const std::size_t share = std::min(regime, split->shares.size() - 1);
      if (most && Reference(split->shares[share].feedthrough) > *most * (1 + Reference("1e-20"))) return false;
    }
  return true;
}

std::optional<Reference> SlipEquations::tie(const ElementList& elements, NodeIndex first, NodeIndex second) const {
  const ReferenceNetwork* form = network(elements);
  if (form == nullptr) return std::nullopt;
  const auto a = end_of(*form, first), b = end_of(*form, second);
  if (!a || !b) return std::nullopt;
  Reference sum = form->springs[*a][*b] + form->dampers[*a][*b] * Reference(facts_.rate);
  for (const ReferenceNetworkMode& mode : form->modes)
    sum -= mode_factors(plain(mode), facts_).gain * mode.weights[*a] * mode.weights[*b];
  const bool is_of_surface = network_.contact && std::max(first, second) == tool && std::min(first, second) == ground;
  return is_of_surface ? Reference(sum + companion(linear_, facts_)) : sum;
}

std::optional<Values> SlipEquations::nodes(const Coupling& coupling) const {
  std::vector<ElementList> elements(coupling.nodes.size());
  for (std::size_t k = coupling.nodes.size(); k-- > 0;) {
    const slip_node<double>& node = coupling.nodes[k];
    const auto place = std::size_t(node.place);
    if (node.kind == slip_part::block && place < coupling.blocks.size()) elements[k] = coupling.blocks[place];
    if (node.kind == slip_part::slip && place < coupling.slips.size()) elements[k] = coupling.slips[place];
    for (int i = 0; i < node.child_count; ++i) {
      const ElementList& child = elements[std::size_t(node.first_child + i)];
      elements[k].insert(elements[k].end(), child.begin(), child.end());
    }
  }
  Values values;
  for (const ElementList& of_node : elements) {
    const ReferencePart* found = part(of_node);
    if (found == nullptr) return std::nullopt;
    const Reference g = stiffness(*found);
    values.insert(values.end(), {g, g > 0 ? Reference(1 / g) : Reference(0), found->yield_force});
  }
  return values;
}

std::optional<Values> SlipEquations::links(const SlipNetwork& table) const {
  const ReferenceNetwork* form = network(table.elements);
  if (form == nullptr) return std::nullopt;
  const auto node = [&](int end) {
    if (end < table.node_count) return table.end_nodes[std::size_t(end)];
    return end == table.node_count ? tool : ground;
  };
  Values values;
  for (const slip_link<double>& link : table.links) {
    if (is_pushed(table) && link.a == table.node_count) {  // the contact, which holds whatever pushes
      const double most = facts_.scalar == ScalarType::float64 ? std::numeric_limits<double>::max()
                                                               : double(std::numeric_limits<float>::max());
      values.insert(values.end(), {0, most});
      continue;
    }
    const auto slip = std::find(form->slips.begin(), form->slips.end(),
                                std::pair<NodeIndex, NodeIndex>(std::minmax(node(link.a), node(link.b))));
    if (slip == form->slips.end()) return std::nullopt;
    const Reference& yield = form->yield_forces[std::size_t(slip - form->slips.begin())];
    values.insert(values.end(), {-yield, yield});
  }
  return values;
}

std::optional<Values> SlipEquations::between(const SlipNetwork& table) const {
  Values values;
  for (const NodeIndex first : table.end_nodes)
    for (const NodeIndex second : table.end_nodes) {
      const std::optional<Reference> value =
          first == second ? std::optional<Reference>(0) : tie(table.elements, first, second);
      if (!value) return std::nullopt;
      values.push_back(*value);
    }
  return values;
}

std::optional<Values> SlipEquations::ties(const SlipNetwork& table, NodeIndex other) const {
  Values values;
  for (const NodeIndex node : table.end_nodes) {
    const std::optional<Reference> value = tie(table.elements, node, other);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

// Behind a contact the tool touches nothing but the surface.
std::optional<Values> SlipEquations::to_tool(const SlipNetwork& table) const {
  return is_pushed(table) ? std::optional(Values(table.end_nodes.size(), 0)) : ties(table, tool);
}

std::optional<Values> SlipEquations::to_ground(const SlipNetwork& table) const { return ties(table, ground); }

std::optional<Reference> SlipEquations::through(const SlipNetwork& table) const {
  return is_pushed(table) ? std::optional<Reference>(0) : tie(table.elements, tool, ground);
}

}  // namespace dashpot::compiler
