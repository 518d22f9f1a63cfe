#include "verify/tunable_equations.hpp"

#include <algorithm>

#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

// The time in which an offset shrinks by 63 %.
const Reference offset_time("0.1");  // [s]

}  // namespace

TunableEquations::TunableEquations(const ReferenceTunables& tunables, const TunableTables& tables,
                                   const Network& network, const LawFacts& facts)
    : tunables_(tunables), tables_(tables), network_(network), facts_(facts), blocks_{&tunables.linear} {
  for (const std::vector<ReferenceBlock>& component : tunables.blocks)
    for (const ReferenceBlock& block : component) blocks_.push_back(&block);
  for (const ReferenceGraph& graph : tunables.graphs)
    for (const ReferenceTie& tie : graph.ties) blocks_.push_back(&tie.block);
  for (const ReferenceBlock* block : blocks_) {
    for (const ReferenceRelaxation& relaxation : block->relaxations)
      if (!relaxation.is_fixed) side_by_side_.insert(side_by_side_.end(), {relaxation.stiffness, relaxation.damping});
    for (const std::vector<ReferenceEdge>& mesh : block->meshes)
      for (const ReferenceEdge& edge : mesh) side_by_side_.push_back(edge.value);
  }
  for (const std::vector<ReferenceSum>& cuts : tunables.yield_forces)
    side_by_side_.insert(side_by_side_.end(), cuts.begin(), cuts.end());
  for (ReferenceSum& sum : side_by_side_) sum.elements = sorted(std::move(sum.elements));
}

std::optional<Reference> TunableEquations::value(const Coefficient& constant) const {
  const Reference period = 1 / Reference(facts_.rate);
  const Subject* subject = constant.of.empty() ? nullptr : &constant.of.front();
  const auto* of_number = std::get_if<OfNumber>(subject);
  const auto* of_place = std::get_if<OfTablePlace>(subject);
  const std::size_t place = of_place != nullptr ? of_place->place : 0;
  switch (constant.role) {
    case ConstantRole::element_value: return of_number != nullptr ? element_value(*of_number) : std::nullopt;
    case ConstantRole::relaxation_share:
    case ConstantRole::relaxation_loss: {
      if (of_place == nullptr || place >= tables_.springs.size()) return std::nullopt;
      const ReferenceRelaxation* found = mode(tables_.numbers[std::size_t(tables_.springs[place])].of);
      if (found == nullptr) return std::nullopt;
      if (constant.role == ConstantRole::relaxation_loss) return found->factors.loss;
      return found->factors.gain / found->stiffness.base;
    }
    case ConstantRole::least_yield:
      if (of_place == nullptr || place >= tables_.slip_elements.size()) return std::nullopt;
      return least_yield(tables_.slip_elements[place]);
    case ConstantRole::least_stiffness: {
      if (of_place == nullptr || place >= tables_.block_elements.size()) return std::nullopt;
      const ReferenceBlock* found = block(tables_.block_elements[place]);
      return found != nullptr ? std::optional<Reference>(least_share() * found->largest_stiffness) : std::nullopt;
    }
    case ConstantRole::sample_period: return period;
    case ConstantRole::sample_rate: return Reference(facts_.rate);
    case ConstantRole::retention: return exp(-period / offset_time);
    case ConstantRole::surface_place: return Reference(network_.surface_behind_map());
    case ConstantRole::zero: return Reference(0);
    default: return std::nullopt;
  }
}

std::vector<Reference> TunableEquations::fixed_yields() const {
  std::vector<Reference> all;
  for (const std::vector<ReferenceSum>& cuts : tunables_.yield_forces) {
    if (std::any_of(cuts.begin(), cuts.end(), [](const ReferenceSum& cut) { return !cut.factors.empty(); })) continue;
    const auto least =
        std::min_element(cuts.begin(), cuts.end(),
                         [](const ReferenceSum& one, const ReferenceSum& other) { return one.base < other.base; });
    all.push_back(least->base);
  }
  return all;
}

const ReferenceBlock* TunableEquations::block(const ElementList& elements) const {
  const ElementList wanted = sorted(elements);
  const auto found = std::find_if(blocks_.begin(), blocks_.end(),
                                  [&](const ReferenceBlock* known) { return known->elements == wanted; });
  return found == blocks_.end() ? nullptr : *found;
}

// Of those that no parameter touches.
const ReferenceRelaxation* TunableEquations::mode(const NumberSubject& of) const {
  const ReferenceBlock* found = block(of.elements);
  if (found == nullptr) return nullptr;
  std::size_t place = 0;
  for (const ReferenceRelaxation& relaxation : found->relaxations)
    if (relaxation.is_fixed && place++ == of.mode) return &relaxation;
  return nullptr;
}

std::optional<ReferenceSum> TunableEquations::number(const NumberSubject& of) const {
  const ReferenceBlock* found = block(of.elements);
  switch (of.kind) {
    case NumberKind::block_stiffness: return found ? std::optional(found->stiffness) : std::nullopt;
    case NumberKind::block_damping: return found ? std::optional(found->damping) : std::nullopt;
    case NumberKind::mode_stiffness:
      if (const ReferenceRelaxation* relaxation = mode(of)) return relaxation->stiffness;
      return std::nullopt;
    case NumberKind::mode_damping:
      if (const ReferenceRelaxation* relaxation = mode(of)) return relaxation->damping;
      return std::nullopt;
    case NumberKind::elements: {
      const ElementList wanted = sorted(of.elements);
      const auto sum = std::find_if(side_by_side_.begin(), side_by_side_.end(),
                                    [&](const ReferenceSum& known) { return known.elements == wanted; });
      return sum == side_by_side_.end() ? std::nullopt : std::optional(*sum);
    }
    case NumberKind::observed: {
      ReferenceSum sum{0, {}, of.elements};
      for (const std::size_t i : of.elements) {
        const Element& e = network_.elements[i];
        if (network_.tunable_of(e) == nullptr) sum.base += Reference(value_of(e.law));
      }
      return sum;
    }
  }
  return std::nullopt;
}

// The part of a number that does not change, or the factor of a parameter in it.
std::optional<Reference> TunableEquations::element_value(const OfNumber& of) const {
  const TunableNumber& written = tables_.numbers[of.number];
  const std::optional<ReferenceSum> sum = number(written.of);
  if (!sum || !of.term) return sum ? std::optional(sum->base) : std::nullopt;
  const TunableTerm& term = written.terms[*of.term];
  const Element& element = network_.elements[term.element];
  const bool is_in = std::find(sum->elements.begin(), sum->elements.end(), term.element) != sum->elements.end();
  if (!is_in || network_.tunable_of(element) != tunables_.parameters[term.tunable]) return std::nullopt;
  return Reference(element.share);
}

std::optional<Reference> TunableEquations::least_yield(const ElementList& slip) const {
  const ElementList wanted = sorted(slip);
  for (const std::vector<ReferenceSum>& cuts : tunables_.yield_forces) {
    ElementList all;
    std::optional<Reference> largest;
    for (const ReferenceSum& cut : cuts) {
      all.insert(all.end(), cut.elements.begin(), cut.elements.end());
      const Reference here = at_largest(cut, tunables_.parameters);
      largest = largest ? std::min(*largest, here) : here;
    }
    all = sorted(std::move(all));
    all.erase(std::unique(all.begin(), all.end()), all.end());
    if (all == wanted) return least_share() * *largest;
  }
  return std::nullopt;
}

// Behind a slip no part is softer, and no slip yields sooner, than this share of what they are at most.
Reference TunableEquations::least_share() const {
  return facts_.scalar == ScalarType::float64 ? Reference(0x1p-24) : Reference(0x1p-10);
}

}  // namespace dashpot::compiler
