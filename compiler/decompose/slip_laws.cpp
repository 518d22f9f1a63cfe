#include "decompose/slip_laws.hpp"

#include <algorithm>
#include <cmath>

#include "decompose/beside_slips.hpp"
#include "decompose/part_decomposer.hpp"

namespace dashpot::compiler {
namespace {

PartDecomposer decomposer_of(SlipPart part, const Network& network) {
  return {std::move(part), has_tunables(network), network.contact.has_value()};
}

// If the brake is too weak for all regimes, the rest stays with the motor: any x ≤ b∞ may be taken out of f, and β
// shrinks with the excess that it is a share of. Returns what is left of the brake.
double cap(std::vector<ComponentSplit>& splits, double reach) {
  for (ComponentSplit& split : splits) {
    double floor = 0;
    for (const BrakeShare& share : split.shares) floor = std::max(floor, to_double(share.feedthrough));
    for (BrakeShare& share : split.shares) {
      if (share.damping <= reach) continue;
      if (share.compensation > 0) share.compensation *= std::max(0.0, reach - floor) / (share.damping - floor);
      share.damping = reach;
      share.feedthrough = std::min(share.feedthrough, Real(reach));
    }
    reach -= split.largest_damping();
  }
  return reach;
}

// √b approaches its demand as 1 − e^{−t/lag}, no faster than the slew; the slower of the two is assumed throughout.
double coil_share(const PortDevice& device, double root_span) {
  const double lag = std::max(device.coil_lag(), device.coil_slew() > 0 ? root_span / device.coil_slew() : 0);
  return lag > 0 ? -std::expm1(-device.sample_period() / lag) : 1;
}

// The share of the damping that no slip changes which is certain and not yet used to cover a compensation. It may be
// used with any estimator that does not enlarge the velocity, ‖v̂‖₂ ≤ ‖u̇‖₂.
double assured_share(const PortDevice& device) {
  return device.largest_estimator_gain() <= 1 ? 1 - device.tolerance() : 0;
}

double make_up(const Candidate& linear_part, const PortDevice& device) {
  return std::max(0.0, assured_share(device) * linear_part.damping - linear_part.velocity_gain);
}

// With steps of ρ a sample, 1 − (1 − (N + n) ρ)² of the excess stays uncompensated; and a coil that makes up the share
// κ of what is missing in a sample is up to ρ/κ behind.
double ramp_of(unsigned memory, double share_of_coil) {
  const double of_estimate = memory > 0 ? ramp_error / 2 / memory : 1;
  return std::min(of_estimate, share_of_coil < 1 ? ramp_error_of_coil / 2 * share_of_coil : 1);
}

}  // namespace

std::optional<SlipLaw> slip_law_asked_for(const Choices& choices) {
  const auto* name = std::get_if<std::string>(&choices.decomposition);
  if (name == nullptr || *name == "virtual") return SlipLaw::by_motor;
  for (const SlipLaw law : laws_to_choose_from)
    if (name_of(law) == *name) return law;
  const bool run_decides = *name == "paper" || *name == "faithful";
  return run_decides ? std::nullopt : std::optional(SlipLaw::velocity_free);
}

SlipDecomposer::SlipDecomposer(const Network& network, const NormalForm& form, double reference_frequency) {
  for (const NormalTree& tree : form.components) components_.push_back(component(network, tree, reference_frequency));
  for (const std::vector<std::size_t>& part : form.networks)
    networks_.push_back(in_no_tree(network, part, reference_frequency));
}

SlipDecomposer::Component SlipDecomposer::component(const Network& network, const NormalTree& tree,
                                                    double reference_frequency) {
  SlipPart part{regimes_of(network, tree, reference_frequency), {}, {}};
  const std::vector<SlipElements>& slips = part.regimes.slips;
  part.sliding = form_in_regime(tree, slips, std::vector<bool>(slips.size(), true));
  std::optional<NormalTree> gated = without_dampers_beside_slips(tree);
  if (gated)
    for (const Regime& regime : part.regimes.regimes)
      part.gated.push_back(form_in_regime(*gated, slips, regime.slides));
  return {decomposer_of(std::move(part), network), tree, std::move(gated)};
}

SlipDecomposer::InNoTree SlipDecomposer::in_no_tree(const Network& network, const std::vector<std::size_t>& elements,
                                                    double reference_frequency) {
  SlipPart part{regimes_of(network, elements, reference_frequency), {}, {}};
  if (!part.regimes.regimes.empty()) part.sliding = part.regimes.regimes.back().form;
  std::optional<std::vector<std::size_t>> gated = without_dampers_beside_slips(network, elements);
  if (gated)
    for (const Regime& regime : regimes_of(network, *gated, part.regimes.slips, reference_frequency).regimes)
      part.gated.push_back(regime.form);
  return {decomposer_of(std::move(part), network), elements, std::move(gated)};
}

SlipDecomposition SlipDecomposer::decomposed(const Candidate& linear_part, const SlipPlan& plan,
                                             const PortDevice& device) const {
  SlipDecomposition slips;
  for (const Component& component : components_) {
    slips.components.push_back(component.decomposer.split(plan, device));
    ComponentSplit& split = slips.components.back();
    split.rendered = component.rendered(split.law);
  }
  for (const InNoTree& part : networks_) {
    slips.networks.push_back(part.decomposer.split(plan, device));
    ComponentSplit& split = slips.networks.back();
    split.rendered_elements = part.rendered(split.law);
  }
  if (const std::optional<double> most = device.max_damping())
    cap(slips.networks, cap(slips.components, std::max(0.0, *most - linear_part.damping - plan.reserve)));
  double span = 0;
  for (const ComponentSplit* split : slips.all()) span += split->largest_damping();
  slips.hysteresis = hysteresis_steps * device.encoder_step();
  slips.coil_share = coil_share(device, std::sqrt(span));
  slips.assured_share = assured_share(device);
  slips.make_up = make_up(linear_part, device);
  // In the hold in which a coil gets a command it has not reached it yet, hence one more. That also covers commands
  // that act late by less than a period: the coil is then as far as it would be with the commands of a sample before.
  slips.memory = device.estimate_memory().value_or(0) + (slips.coil_share < 1 ? 1 : 0);
  slips.ramp = ramp_of(slips.memory, slips.coil_share);
  return slips;
}

namespace {

// False, with a diagnostic, where a law was asked for that no part can have.
bool has_what_was_asked_for(const Network& network, const SlipDecomposition& slips, SlipLaw asked,
                            Diagnostics& diagnostics) {
  if (asked == SlipLaw::by_motor || asked == SlipLaw::velocity_free) return true;
  for (const ComponentSplit* split : slips.all())
    if (split->law == asked) return true;
  const ComponentSplit& first = *slips.all().front();
  diagnostics.report<DiagnosticCode::no_such_slip_law>(network.elements[first.regimes.slips.front().front()].span,
                                                       name_of(asked), name_of(first, network), first.reason);
  diagnostics.note<DiagnosticCode::take_another_slip_law>({});
  return false;
}

// Drops the names of laws behind slips that no part can have: asking for them would be refused.
void list_what_can_be_asked_for(Decomposition& result) {
  const auto has = [&](const std::string& name) {
    for (const ComponentSplit* split : result.slips.all())
      for (const SlipLawOffer& offer : split->offers)
        if (name_of(offer.law) == name && offer.refusal.empty()) return true;
    return false;
  };
  const std::string chosen = result.choice().name;
  std::erase_if(result.candidates, [&](const Candidate& candidate) {
    const bool is_slip_law = candidate.name == name_of(SlipLaw::steady) || candidate.name == name_of(SlipLaw::ramped) ||
                             candidate.name == name_of(SlipLaw::gated);
    return is_slip_law && candidate.name != chosen && !has(candidate.name);
  });
  const auto place = std::find_if(result.candidates.begin(), result.candidates.end(),
                                  [&](const Candidate& candidate) { return candidate.name == chosen; });
  result.chosen = static_cast<std::size_t>(place - result.candidates.begin());
}

}  // namespace

SlipDecomposition with_reasons(SlipDecomposition slips, const std::string& reason) {
  for (std::vector<ComponentSplit>* parts : {&slips.components, &slips.networks})
    for (ComponentSplit& split : *parts)
      if (split.reason.empty()) split.reason = reason.empty() ? split.offers.back().refusal : reason;
  return slips;
}

ExtremeRuns extreme_runs(const std::vector<SlipRunError>& runs) {
  const auto [mildest, worst] = std::minmax_element(
      runs.begin(), runs.end(), [](const SlipRunError& a, const SlipRunError& b) { return a.error < b.error; });
  return {*mildest, *worst};
}

std::optional<Decomposition> decompose(const Network& network, const NormalForm& form,
                                       const SlipDecomposer& behind_slips, const Choices& choices,
                                       const PortDevice& device, Diagnostics& diagnostics) {
  std::optional<Decomposition> result =
      decompose(linear_part(network, form), form.linear, choices, device, diagnostics);
  if (!result || !form.has_slips()) return result;
  const SlipLaw law = slip_law_asked_for(choices).value_or(SlipLaw::velocity_free);
  result->slips = with_reasons(
      behind_slips.decomposed(result->choice(), {law, 1, device.largest_estimator_gain()}, device), "asked for");
  if (!has_what_was_asked_for(network, result->slips, law, diagnostics)) return std::nullopt;
  list_what_can_be_asked_for(*result);
  return result;
}

}  // namespace dashpot::compiler
