#include "verify/reference_slips.hpp"

#include <algorithm>

#include "decompose/regimes.hpp"
#include "network/law.hpp"
#include "verify/reference_network.hpp"

namespace dashpot::compiler {
namespace {

std::optional<ReferenceCut> least_cut(const ReferencePart& part, const LawFacts& facts, const Reference& weight) {
  if (part.kind == ReferencePart::Kind::block) return reference_cut(part.form, facts);
  if (part.kind == ReferencePart::Kind::slip) return std::nullopt;
  std::optional<ReferenceCut> least;
  ReferenceCut sum{0, 0};
  for (const ReferencePart& child : part.children) {
    const std::optional<ReferenceCut> cut = least_cut(child, facts, weight);
    if (!cut && part.kind == ReferencePart::Kind::parallel) return std::nullopt;
    if (!cut) continue;
    sum = {sum.stiffness + cut->stiffness, sum.damping + cut->damping};
    if (!least || cut->stiffness * weight + cut->damping < least->stiffness * weight + least->damping) least = cut;
  }
  return part.kind == ReferencePart::Kind::series ? least : sum;
}

// The same of a part that is no tree: all ways to part its ends that no slip crosses.
ReferenceCut least_cut(const Network& network, const std::vector<std::size_t>& elements, const LawFacts& facts,
                       const Reference& weight) {
  const ReferenceNetwork form = reference_network(network, elements);
  const std::size_t inner = form.ends.size() - 2;
  std::optional<ReferenceCut> least;
  for (std::size_t pattern = 0; pattern < std::size_t{1} << inner; ++pattern) {
    const auto at_tool = [&](std::size_t end) { return end < inner ? (pattern >> end & 1u) != 0 : end == inner; };
    const auto place = [&](NodeIndex node) {
      return std::size_t(std::find(form.ends.begin(), form.ends.end(), node) - form.ends.begin());
    };
    const bool is_crossed = std::any_of(elements.begin(), elements.end(), [&](std::size_t i) {
      const Element& e = network.elements[i];
      return is_slip(e.law) && at_tool(place(e.a)) != at_tool(place(e.b));
    });
    if (is_crossed) continue;
    ReferenceCut cut{0, 0};
    for (std::size_t a = 0; a < form.ends.size(); ++a)
      for (std::size_t b = 0; b < form.ends.size(); ++b)
        if (at_tool(a) && !at_tool(b)) cut = {cut.stiffness + form.springs[a][b] / 2, cut.damping + form.dampers[a][b]};
    for (const ReferenceNetworkMode& mode : form.modes) {
      Reference pull = 0;
      for (std::size_t a = 0; a < form.ends.size(); ++a) pull += at_tool(a) ? mode.weights[a] : Reference(0);
      const ModeFactors f = mode_factors({mode.stiffness, mode.relaxation_rate, 1}, facts);
      cut.stiffness += pull * pull * f.gain / (1 + f.decay);
    }
    if (!least || cut.stiffness * weight + cut.damping < least->stiffness * weight + least->damping) least = cut;
  }
  return least.value();
}

}  // namespace

ReferenceCut reference_cut(const ReferenceForm& form, const LawFacts& facts) {
  ReferenceCut cut{form.static_stiffness / 2, form.feedthrough_damping};
  for (const ReferenceMode& mode : form.modes) {
    const ModeFactors f = mode_factors(mode, facts);
    cut.stiffness += f.gain / (1 + f.decay);
  }
  return cut;
}

ReferenceTree rendered_tree(ReferenceTree tree, const Network& network, const SlipDecomposition& slips) {
  for (std::size_t i = 0; i < std::min(tree.components.size(), slips.components.size()); ++i)
    if (slips.components[i].law == SlipLaw::gated)
      tree.components[i] = without_dampers_beside_slips(std::move(tree.components[i]));
  for (std::size_t i = 0; i < std::min(tree.networks.size(), slips.networks.size()); ++i) {
    if (slips.networks[i].law != SlipLaw::gated) continue;
    const std::vector<std::size_t> all = tree.networks[i];
    std::erase_if(tree.networks[i], [&](std::size_t index) {
      const Element& damper = network.elements[index];
      return is_damper(damper.law) && std::any_of(all.begin(), all.end(), [&](std::size_t other) {
               const Element& slip = network.elements[other];
               return is_slip(slip.law) && std::minmax(slip.a, slip.b) == std::minmax(damper.a, damper.b);
             });
    });
  }
  return tree;
}

ReferenceCut reference_cut(const ReferenceTree& tree, const Network& network, const SlipDecomposition& slips,
                           const LawFacts& facts, double lateness) {
  const Reference weight = Reference(lateness) * Reference(lateness) / Reference(facts.rate);
  const bool with_contact = network.contact.has_value();
  ReferenceCut sum{0, 0, 0};
  const auto add = [&](const ReferenceCut& cut) { sum.stiffness += cut.stiffness, sum.damping += cut.damping; };
  const auto less_the_brake = [&](const auto& splits, std::size_t i) {
    if (with_contact || i >= splits.size() || splits[i].shares.empty()) return;
    Reference least = Reference(splits[i].shares.front().feedthrough);
    for (const BrakeShare& share : splits[i].shares) least = std::min(least, Reference(share.feedthrough));
    sum.brakes += least;
  };
  for (std::size_t i = 0; i < tree.components.size(); ++i) {
    add(least_cut(tree.components[i], facts, weight).value());
    less_the_brake(slips.components, i);
  }
  for (std::size_t i = 0; i < tree.networks.size(); ++i) {
    add(least_cut(network, tree.networks[i], facts, weight));
    less_the_brake(slips.networks, i);
  }
  if (with_contact) add(reference_cut(tree.linear, facts));
  return sum;
}

Reference ReferenceCut::of_motor() const {
  const Reference left = damping - brakes;
  return left > damping * Reference("1e-30") ? left : Reference(0);
}

}  // namespace dashpot::compiler
