#include "decompose/slip_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "decompose/spectrum.hpp"

namespace dashpot::compiler {
namespace {

bool has_force(const LinearForm& form) {
  return form.static_stiffness > 0 || form.feedthrough_damping > 0 || !form.modes.empty();
}

// D(s) of what is left when every slip slides; nothing where that is a constant force.
LinearForm sliding_form(const NormalTree& tree) {
  if (tree.kind == NormalTree::Kind::block) return tree.form;
  LinearForm sum;
  for (const NormalTree& child : tree.children) {
    const LinearForm form = sliding_form(child);
    if (tree.kind == NormalTree::Kind::series && !has_force(form)) return {};
    sum = in_parallel(std::move(sum), tree.kind == NormalTree::Kind::series ? reciprocal(form) : form);
  }
  return tree.kind == NormalTree::Kind::series ? reciprocal(sum) : sum;
}

bool is_slip(const NormalTree& tree) { return tree.kind == NormalTree::Kind::slip; }

// The component without the dampers that lie beside its slips. True where there was one.
bool drop_dampers_beside_slips(NormalTree& tree) {
  bool dropped = false;
  const bool beside = tree.kind == NormalTree::Kind::parallel && std::any_of(tree.children.begin(), tree.children.end(), is_slip);
  for (NormalTree& child : tree.children) {
    if (child.kind != NormalTree::Kind::block) dropped |= drop_dampers_beside_slips(child);
    if (child.kind != NormalTree::Kind::block || !beside || child.form.feedthrough_damping == 0) continue;
    child.form.feedthrough_damping = 0;
    dropped = true;
  }
  std::erase_if(tree.children, [](const NormalTree& child) { return child.kind == NormalTree::Kind::block && !has_force(child.form); });
  if (tree.children.size() == 1) tree = NormalTree(std::move(tree.children.front()));
  return dropped;
}

std::complex<double> impedance(const LinearForm& form, double w) {
  return viscous_impedance(form, w) + to_double(form.static_stiffness) / std::complex(0.0, w);
}

BrakeShare velocity_free_share(const Real& feedthrough) { return {to_double(feedthrough), feedthrough, 0}; }

std::vector<BrakeShare> velocity_free_shares(const RegimeList& list) {
  std::vector<BrakeShare> shares;
  for (const Regime& regime : list.regimes) shares.push_back(velocity_free_share(regime.feedthrough()));
  return shares;
}

class ComponentDecomposer {
 public:
  ComponentDecomposer(const Network& network, const NormalTree& component, const LinearForm& beside, const PortDevice& device)
      : component_(component), without_dampers_(component), beside_(beside), device_(device),
        behind_contact_(network.contact.has_value()),
        is_tunable_(std::any_of(network.parameters.begin(), network.parameters.end(), [](const Parameter& p) { return p.tunable; })),
        regimes_(regimes_of(network, component, device.reference_frequency())) {
    can_be_gated_ = drop_dampers_beside_slips(without_dampers_);
    sliding_ = sliding_form(component_);
    if (!has_one_slip()) return;
    gated_sliding_ = sliding_form(without_dampers_);
  }

  ComponentSplit split(const std::variant<std::string, double>& decomposition) const {
    ComponentSplit split{component_, regimes_, {}, {}, SlipLaw::by_motor, ""};
    for (SlipLaw law : {SlipLaw::velocity_free, SlipLaw::gated, SlipLaw::compensated}) split.merits.push_back(merit(law));
    choose(decomposition, split);
    if (split.law == SlipLaw::gated) split.rendered = without_dampers_;
    split.shares = shares(split.law);
    return split;
  }

 private:
  bool has_one_slip() const { return regimes_.slips.size() == 1; }
  const Regime& stuck() const { return regimes_.regimes.front(); }
  const Regime& sliding() const { return regimes_.regimes.back(); }
  double brake() const { return to_double(sliding().damping); }
  double excess_brake() const { return to_double(sliding().damping - sliding().feedthrough()); }
  double compensation() const { return std::min(excess_brake(), (1 - device_.tolerance()) * brake()); }

  void choose(const std::variant<std::string, double>& decomposition, ComponentSplit& split) const {
    const auto* name = std::get_if<std::string>(&decomposition);
    if (name == nullptr || *name == "virtual") {
      split.reason = "the brake's damping does not change";
    } else if (!hindrance_to_choice().empty()) {
      take(SlipLaw::velocity_free, hindrance_to_choice(), split);
    } else if (*name == "most-dissipative") {
      choose_most_dissipative(split);
    } else {
      take(*name == name_of(SlipLaw::gated) ? SlipLaw::gated : *name == name_of(SlipLaw::compensated) ? SlipLaw::compensated : SlipLaw::velocity_free,
           "asked for", split);
    }
  }

  // Why there is but one law; empty where there are several.
  std::string hindrance_to_choice() const {
    if (behind_contact_) return "slips are behind a contact";
    if (is_tunable_) return "parameters change while it runs; b is that of their default values";
    return has_one_slip() ? "" : fmt::format("{} slips are coupled", regimes_.slips.size());
  }

  void choose_most_dissipative(ComponentSplit& split) const {
    const SlipLawMerit &gated = split.merits[1], &compensated = split.merits[2];
    const std::string error = fmt::format("the gated law errs by {:.3g} % in the band", 100 * gated.largest_error);
    if (!gated.refusal.empty()) return take(SlipLaw::velocity_free, gated.refusal, split);
    if (gated.largest_error <= gated_tolerance) return take(SlipLaw::gated, fmt::format("{}, no more than {:.3g} %", error, 100 * gated_tolerance), split);
    if (compensated.refusal.empty()) return take(SlipLaw::compensated, error, split);
    take(SlipLaw::velocity_free, error + ", and " + compensated.refusal, split);
  }

  void take(SlipLaw law, std::string reason, ComponentSplit& split) const {
    const auto chosen = std::find_if(split.merits.begin(), split.merits.end(), [=](const SlipLawMerit& merit) { return merit.law == law; });
    split.law = chosen->refusal.empty() ? law : SlipLaw::velocity_free;
    split.reason = chosen->refusal.empty() ? std::move(reason) : chosen->refusal;
  }

  SlipLawMerit merit(SlipLaw law) const {
    SlipLawMerit merit{law, 0, 0.0, refusal_of(law)};
    if (!merit.refusal.empty()) return merit;
    merit.largest_error = largest_in_band(device_, [&](double w) { return error(law, w); });
    if (law != SlipLaw::compensated) return merit;
    const std::optional<double> noise = device_.velocity_noise();
    merit.motor_noise = noise ? std::optional(compensation() * *noise) : std::nullopt;
    return merit;
  }

  std::string refusal_of(SlipLaw law) const {
    if (law == SlipLaw::velocity_free) return "";
    if (!hindrance_to_choice().empty()) return hindrance_to_choice();
    if (excess_brake() <= 0) return "what slides has no damping but at the tool";
    if (law == SlipLaw::gated) return can_be_gated_ ? "" : "no damper lies beside the slip";
    if (!device_.estimate_memory()) return fmt::format("the estimator '{}' never forgets or is not linear", device_.estimator_name());
    return "";
  }

  double error(SlipLaw law, double w) const {
    const std::complex<double> whole = impedance(beside_, w) + impedance(sliding_, w);
    std::complex<double> error = 0;
    if (law == SlipLaw::gated)
      error = brake() + impedance(gated_sliding_, w) - to_double(gated_sliding_.feedthrough_damping) - impedance(sliding_, w);
    if (law == SlipLaw::compensated) error = excess_brake() - compensation() * device_.velocity_response(w);
    return std::abs(error) == 0 ? 0 : std::abs(error) / std::abs(whole);
  }

  std::vector<BrakeShare> shares(SlipLaw law) const {
    if (law == SlipLaw::by_motor) return std::vector<BrakeShare>(std::max<std::size_t>(regimes_.regimes.size(), 1));
    // b∞ of the regimes that are not listed is no less than that with all slips sliding.
    if (regimes_.regimes.empty()) return {velocity_free_share(sliding_.feedthrough_damping)};
    std::vector<BrakeShare> shares = velocity_free_shares(regimes_);
    if (law == SlipLaw::velocity_free) return shares;
    shares.back().damping = brake();
    if (law == SlipLaw::gated) shares.back().feedthrough = gated_sliding_.feedthrough_damping;
    if (law == SlipLaw::compensated) shares.back().compensation = compensation();
    return shares;
  }

  const NormalTree& component_;
  NormalTree without_dampers_;
  const LinearForm& beside_;
  const PortDevice& device_;
  bool behind_contact_, is_tunable_;
  RegimeList regimes_;
  bool can_be_gated_ = false;
  LinearForm sliding_, gated_sliding_;
};

// Slips that meet in no tree: what holds in every regime is b∞, so that one law is left.
ComponentSplit split_of_network(const Network& network, const std::vector<std::size_t>& elements,
                                const std::variant<std::string, double>& decomposition, const PortDevice& device) {
  ComponentSplit split{{}, regimes_of(network, elements, device.reference_frequency()), {}, {}, SlipLaw::by_motor,
                       "the brake's damping does not change"};
  const std::string others = fmt::format("{} slips in no tree", split.regimes.slips.size());
  split.merits = {{SlipLaw::velocity_free, 0, 0.0, ""}, {SlipLaw::gated, 0, 0.0, others}, {SlipLaw::compensated, 0, 0.0, others}};
  const auto* name = std::get_if<std::string>(&decomposition);
  split.shares.resize(std::max<std::size_t>(split.regimes.regimes.size(), 1));
  if (name == nullptr || *name == "virtual") return split;
  split.law = SlipLaw::velocity_free;
  split.reason = others;
  if (!split.regimes.regimes.empty()) split.shares = velocity_free_shares(split.regimes);
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

// What the brake cannot give to all regimes at once stays in the motor: any x ≤ b∞ may be taken out of f. Returns what is
// left of the brake.
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
double assured_share(const PortDevice& device) { return device.largest_estimator_gain() <= 1 ? 1 - device.tolerance() : 0; }

double make_up(const Candidate& linear_part, const PortDevice& device) {
  return std::max(0.0, assured_share(device) * linear_part.damping - linear_part.velocity_gain);
}

}  // namespace

SlipDecomposition decompose_slips(const Network& network, const NormalForm& form, const Candidate& linear_part,
                                  const Choices& choices, const PortDevice& device) {
  SlipDecomposition slips;
  if (!network.contact || form.networks.empty())
    for (const NormalTree& component : form.components)
      slips.components.push_back(ComponentDecomposer(network, component, form.linear, device).split(choices.decomposition));
  for (const std::vector<std::size_t>& part : network_parts(network, form))
    slips.networks.push_back(split_of_network(network, part, choices.decomposition, device));
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

std::optional<Decomposition> decompose(const Network& network, const NormalForm& form, const Choices& choices,
                                       const Device* device, Diagnostics& diagnostics) {
  std::optional<Decomposition> result = decompose(linear_part(network, form), form.linear, choices, device, diagnostics);
  if (!result || !form.has_slips()) return result;
  const std::optional<PortDevice> port = device ? PortDevice::of(*device, network, diagnostics) : PortDevice::ideal();
  if (port) result->slips = decompose_slips(network, form, result->choice(), choices, *port);
  return result;
}

}  // namespace dashpot::compiler
