#include "decompose/slip_laws.hpp"

#include <algorithm>
#include <cmath>

#include "decompose/beside_slips.hpp"
#include "decompose/part_decomposer.hpp"

namespace dashpot::compiler {
namespace {

bool has_tunables(const Network& network) {
  return std::any_of(network.parameters.begin(), network.parameters.end(),
                     [](const Parameter& p) { return p.tunable; });
}

ComponentSplit split_of_component(const Network& network, const NormalTree& component, const LinearForm& beside,
                                  const std::variant<std::string, double>& decomposition, const PortDevice& device) {
  SlipPart part{regimes_of(network, component, device.reference_frequency()), {}, {}};
  const std::vector<SlipElements>& slips = part.regimes.slips;
  part.sliding = form_in_regime(component, slips, std::vector<bool>(slips.size(), true));
  const std::optional<NormalTree> gated = without_dampers_beside_slips(component);
  if (gated)
    for (const Regime& regime : part.regimes.regimes)
      part.gated.push_back(form_in_regime(*gated, slips, regime.slides));
  ComponentSplit split = PartDecomposer(std::move(part), beside, device, has_tunables(network)).split(decomposition);
  split.rendered = split.law == SlipLaw::gated ? *gated : component;
  return split;
}

// Slips that meet in no tree.
ComponentSplit split_of_network(const Network& network, const std::vector<std::size_t>& elements,
                                const LinearForm& beside, const std::variant<std::string, double>& decomposition,
                                const PortDevice& device) {
  SlipPart part{regimes_of(network, elements, device.reference_frequency()), {}, {}};
  if (!part.regimes.regimes.empty()) part.sliding = part.regimes.regimes.back().form;
  const std::optional<std::vector<std::size_t>> gated = without_dampers_beside_slips(network, elements);
  if (gated)
    for (const Regime& regime : regimes_of(network, *gated, part.regimes.slips, device.reference_frequency()).regimes)
      part.gated.push_back(regime.form);
  ComponentSplit split = PartDecomposer(std::move(part), beside, device, has_tunables(network)).split(decomposition);
  split.rendered_elements = split.law == SlipLaw::gated ? *gated : elements;
  return split;
}

// With a contact and a part that is no tree, all slips are solved together.
std::vector<std::vector<std::size_t>> network_parts(const Network& network, const NormalForm& form) {
  if (!network.contact || form.networks.empty()) return form.networks;
  std::vector<std::size_t> elements;
  for (const NormalTree& component : form.components)
    for (std::size_t element : elements_of(component)) elements.push_back(element);
  for (const std::vector<std::size_t>& part : form.networks) elements.insert(elements.end(), part.begin(), part.end());
  return {elements};
}

double largest_damping(const ComponentSplit& split) {
  double largest = 0;
  for (const BrakeShare& share : split.shares) largest = std::max(largest, share.damping);
  return largest;
}

// What the brake cannot give to all regimes at once stays in the motor: any x ≤ b∞ may be taken out of f. Returns what
// is left of the brake.
double cap(std::vector<ComponentSplit>& splits, double reach) {
  for (ComponentSplit& split : splits) {
    for (BrakeShare& share : split.shares) {
      if (share.damping <= reach) continue;
      share.damping = reach;
      share.feedthrough = std::min(share.feedthrough, Real(reach));
      share.compensation = std::min(share.compensation, to_double(reach - share.feedthrough));
    }
    reach -= largest_damping(split);
  }
  return reach;
}

// √b approaches its demand as 1 − e^{−t/lag}, no faster than the slew; the slower of both is assumed all the way.
double coil_share(const PortDevice& device, double root_span) {
  const double lag = std::max(device.coil_lag(), device.coil_slew() > 0 ? root_span / device.coil_slew() : 0);
  return lag > 0 ? -std::expm1(-device.sample_period() / lag) : 1;
}

// Of the damping that no slip changes, what is certain and does not cover a compensation yet. With a constant bound any
// estimator will do that does not make the velocity larger, ‖v̂‖₂ ≤ ‖u̇‖₂.
double assured_share(const PortDevice& device) {
  return device.largest_estimator_gain() <= 1 ? 1 - device.tolerance() : 0;
}

double make_up(const Candidate& linear_part, const PortDevice& device) {
  return std::max(0.0, assured_share(device) * linear_part.damping - linear_part.velocity_gain);
}

}  // namespace

SlipDecomposition decompose_slips(const Network& network, const NormalForm& form, const Candidate& linear_part,
                                  const Choices& choices, const PortDevice& device) {
  SlipDecomposition slips;
  if (!network.contact || form.networks.empty())
    for (const NormalTree& component : form.components)
      slips.components.push_back(split_of_component(network, component, form.linear, choices.decomposition, device));
  for (const std::vector<std::size_t>& part : network_parts(network, form))
    slips.networks.push_back(split_of_network(network, part, form.linear, choices.decomposition, device));
  if (const std::optional<double> most = device.max_damping())
    cap(slips.networks, cap(slips.components, std::max(0.0, *most - linear_part.damping)));
  double span = 0;
  for (const ComponentSplit* split : slips.all()) span += largest_damping(*split);
  slips.hysteresis = hysteresis_steps * device.encoder_step();
  slips.coil_share = coil_share(device, std::sqrt(span));
  slips.assured_share = assured_share(device);
  slips.make_up = make_up(linear_part, device);
  slips.hold_samples = device.estimate_memory().value_or(0) + (slips.coil_share < 1 ? 1 : 0);
  return slips;
}

namespace {

// False, with a diagnostic, where a law was asked for that no part can have.
bool has_what_was_asked_for(const Network& network, const SlipDecomposition& slips, const Choices& choices,
                            Diagnostics& diagnostics) {
  const auto* name = std::get_if<std::string>(&choices.decomposition);
  if (name == nullptr || (*name != name_of(SlipLaw::gated) && *name != name_of(SlipLaw::compensated))) return true;
  for (const ComponentSplit* split : slips.all())
    if (name_of(split->law) == *name) return true;
  const ComponentSplit& first = *slips.all().front();
  diagnostics.report<DiagnosticCode::no_such_slip_law>(network.elements[first.regimes.slips.front().front()].span,
                                                       *name, name_of(first, network), first.reason);
  diagnostics.note<DiagnosticCode::take_another_slip_law>({});
  return false;
}

}  // namespace

std::optional<Decomposition> decompose(const Network& network, const NormalForm& form, const Choices& choices,
                                       const Device* device, Diagnostics& diagnostics) {
  std::optional<Decomposition> result =
      decompose(linear_part(network, form), form.linear, choices, device, diagnostics);
  if (!result || !form.has_slips()) return result;
  const std::optional<PortDevice> port = device ? PortDevice::of(*device, network, diagnostics) : PortDevice::ideal();
  if (!port) return result;
  result->slips = decompose_slips(network, form, result->choice(), choices, *port);
  return has_what_was_asked_for(network, result->slips, choices, diagnostics) ? std::move(result) : std::nullopt;
}

}  // namespace dashpot::compiler
