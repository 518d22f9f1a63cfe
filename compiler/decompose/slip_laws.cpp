#include "decompose/slip_laws.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

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

class ComponentDecomposer {
 public:
  ComponentDecomposer(const Network& network, const NormalTree& component, const LinearForm& beside, const PortDevice& device)
      : component_(component), without_dampers_(component), beside_(beside), device_(device),
        behind_contact_(network.contact.has_value()),
        regimes_(regimes_of(network, component, device.reference_frequency())) {
    can_be_gated_ = drop_dampers_beside_slips(without_dampers_);
    if (!has_one_slip()) return;
    sliding_ = sliding_form(component_);
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
    } else if (behind_contact_) {
      split.reason = "with the contact all slips are solved together";
    } else if (!has_one_slip()) {
      split.reason = fmt::format("{} slips are coupled", regimes_.slips.size());
    } else if (*name == "most-dissipative") {
      choose_most_dissipative(split);
    } else {
      take(*name == name_of(SlipLaw::gated) ? SlipLaw::gated : *name == name_of(SlipLaw::compensated) ? SlipLaw::compensated : SlipLaw::velocity_free,
           "asked for", split);
    }
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
    if (behind_contact_) return "slips are behind a contact";
    if (!has_one_slip()) return "slips are coupled";
    if (law == SlipLaw::velocity_free) return "";
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
    std::vector<BrakeShare> shares(regimes_.regimes.size());
    if (law == SlipLaw::by_motor) return shares;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      shares[i].feedthrough = regimes_.regimes[i].feedthrough();
      shares[i].damping = to_double(shares[i].feedthrough);
    }
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
  bool behind_contact_;
  RegimeList regimes_;
  bool can_be_gated_ = false;
  LinearForm sliding_, gated_sliding_;
};

double largest_damping(const ComponentSplit& split) {
  double largest = 0;
  for (const BrakeShare& share : split.shares) largest = std::max(largest, share.damping);
  return largest;
}

// What the brake cannot give to all regimes at once stays in the motor: any x ≤ b∞ may be taken out of f.
void cap(std::vector<ComponentSplit>& components, double reach) {
  for (ComponentSplit& split : components) {
    for (BrakeShare& share : split.shares) {
      if (share.damping <= reach) continue;
      share.damping = reach;
      share.feedthrough = std::min(share.feedthrough, Real(reach));
      share.compensation = std::min(share.compensation, to_double(reach - share.feedthrough));
    }
    reach -= largest_damping(split);
  }
}

// √b approaches its demand as 1 − e^{−t/lag}, no faster than the slew; the slower of both is assumed all the way.
double coil_share(const PortDevice& device, double root_span) {
  const double lag = std::max(device.coil_lag(), device.coil_slew() > 0 ? root_span / device.coil_slew() : 0);
  return lag > 0 ? -std::expm1(-device.sample_period() / lag) : 1;
}

// Of the damping that no slip changes, what is certain and does not cover a compensation yet. With a constant bound any
// estimator will do that does not make the velocity larger, ‖v̂‖₂ ≤ ‖u̇‖₂.
double make_up(const Candidate& linear_part, const PortDevice& device) {
  if (!(device.largest_estimator_gain() <= 1)) return 0;
  return std::max(0.0, (1 - device.tolerance()) * linear_part.damping - linear_part.velocity_gain);
}

bool offers_choice(const ComponentSplit& split) {
  return std::count_if(split.merits.begin(), split.merits.end(), [](const SlipLawMerit& merit) { return merit.refusal.empty(); }) > 1;
}

bool is_like(const ComponentSplit& first, const ComponentSplit& second) {
  const auto same = [](const BrakeShare& x, const BrakeShare& y) {
    return x.damping == y.damping && x.feedthrough == y.feedthrough && x.compensation == y.compensation;
  };
  return first.law == second.law && first.reason == second.reason &&
         std::equal(first.shares.begin(), first.shares.end(), second.shares.begin(), second.shares.end(), same);
}

bool asks_the_brake(const ComponentSplit& split) {
  return std::any_of(split.regimes.regimes.begin(), split.regimes.regimes.end(), [](const Regime& regime) { return regime.damping > 0; });
}

std::string regimes_text(const ComponentSplit& split, const Network& network) {
  std::string text = fmt::format("  {:<24}{:>14}{:>16}{:>14}{:>14}  observer\n", "stuck", "b", "its observer's", "b∞", "compensation");
  for (std::size_t i = 0; i < split.regimes.regimes.size(); ++i) {
    const Regime& regime = split.regimes.regimes[i];
    const std::vector<std::string> stuck = slip_names(split.regimes, regime, false, network);
    text += fmt::format("  {:<24}{:>14.8g}{:>16.8g}{:>14.8g}{:>14.8g}  {}\n", stuck.empty() ? "-" : fmt::format("{}", fmt::join(stuck, ", ")),
                        split.shares[i].damping, to_double(regime.damping), to_double(regime.feedthrough()),
                        split.shares[i].compensation, regime.reason);
  }
  return text;
}

std::string laws_text(const ComponentSplit& split) {
  std::string text = fmt::format("  {:<16}{:>12}{:>14}\n", "law", "error", "motor noise");
  for (const SlipLawMerit& merit : split.merits)
    if (merit.refusal.empty())
      text += fmt::format("  {:<16}{:>11.4g}%{:>14}\n", name_of(merit.law), 100 * merit.largest_error,
                          merit.motor_noise ? fmt::format("{:.4g}", *merit.motor_noise) : "not linear");
    else
      text += fmt::format("  {:<16}  not to be had: {}\n", name_of(merit.law), merit.refusal);
  return text;
}

}  // namespace

std::string_view name_of(SlipLaw law) {
  switch (law) {
    case SlipLaw::by_motor: return "by-motor";
    case SlipLaw::velocity_free: return "velocity-free";
    case SlipLaw::gated: return "gated";
    case SlipLaw::compensated: return "compensated";
  }
  return "";
}

SlipDecomposition decompose_slips(const Network& network, const NormalForm& form, const Candidate& linear_part,
                                  const Choices& choices, const PortDevice& device) {
  SlipDecomposition slips;
  for (const NormalTree& component : form.components)
    slips.components.push_back(ComponentDecomposer(network, component, form.linear, device).split(choices.decomposition));
  if (const std::optional<double> most = device.max_damping()) cap(slips.components, std::max(0.0, *most - linear_part.damping));
  double span = 0;
  for (const ComponentSplit& split : slips.components) span += largest_damping(split);
  slips.hysteresis = hysteresis_steps * device.encoder_step();
  slips.coil_share = coil_share(device, std::sqrt(span));
  slips.make_up = make_up(linear_part, device);
  slips.hold_samples = device.estimate_memory().value_or(0) + (slips.coil_share < 1 ? 1 : 0);
  return slips;
}

std::optional<Decomposition> decompose(const Network& network, const NormalForm& form, const Choices& choices,
                                       const Device* device, Diagnostics& diagnostics) {
  std::optional<Decomposition> result = decompose(linear_part(network, form), form.linear, choices, device, diagnostics);
  if (!result || form.components.empty()) return result;
  const std::optional<PortDevice> port = device ? PortDevice::of(*device, network, diagnostics) : PortDevice::ideal();
  if (port) result->slips = decompose_slips(network, form, result->choice(), choices, *port);
  return result;
}

std::vector<std::string> slip_names(const RegimeList& list, const Regime& regime, bool sliding, const Network& network) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < list.slips.size(); ++i)
    if (regime.slides[i] == sliding)
      for (std::size_t element : list.slips[i]) names.push_back(network.elements[element].name);
  return names;
}

std::string name_of(const ComponentSplit& split, const Network& network) {
  std::string names;
  for (std::size_t i = 0; i < split.regimes.slips.size(); ++i)
    names += (i == 0 ? "" : ", ") + network.elements[split.regimes.slips[i].front()].name;
  return names;
}

std::vector<SlipLikes> likes_of(const SlipDecomposition& slips, const Network& network) {
  std::vector<SlipLikes> all;
  for (const ComponentSplit& split : slips.components) {
    const auto like = std::find_if(all.begin(), all.end(), [&](const SlipLikes& other) { return is_like(*other.first, split); });
    if (like == all.end())
      all.push_back({&split, {name_of(split, network)}});
    else
      like->names.push_back(name_of(split, network));
  }
  return all;
}

std::string to_text(const SlipLikes& likes) {
  const std::size_t shown = std::min<std::size_t>(likes.names.size(), 4);
  std::string names;
  for (std::size_t i = 0; i < shown; ++i) names += (i == 0 ? "" : "; ") + likes.names[i];
  if (shown < likes.names.size()) names += fmt::format(" and {} more", likes.names.size() - shown);
  return fmt::format("behind {}: {}, {}", names, name_of(likes.first->law), likes.first->reason);
}

std::string to_text(const SlipDecomposition& slips, const Network& network) {
  std::string text;
  for (const SlipLikes& likes : likes_of(slips, network)) {
    text += fmt::format("{}\n", to_text(likes));
    text += fmt::format("  {} regimes{}\n", likes.first->regimes.count, likes.names.size() > 1 ? " each" : "");
    if (asks_the_brake(*likes.first)) text += regimes_text(*likes.first, network);
    if (offers_choice(*likes.first)) text += laws_text(*likes.first);
  }
  return text;
}

}  // namespace dashpot::compiler
