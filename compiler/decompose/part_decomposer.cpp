#include "decompose/part_decomposer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "decompose/slip_laws.hpp"

namespace dashpot::compiler {
namespace {

// `to`, if the value differs from it by rounding only.
Real snapped(const Real& value, const Real& to) { return abs(value - to) <= abs(to) * Real("1e-30") ? to : value; }

// A little less, so that rounding of the emitted constants, also in single precision, never exceeds the limit.
constexpr double careful = 1 - 1e-6;

}  // namespace

double compensated_share(const PortDevice& device) {
  return device.assured_share() * device.sample_period() / device.longest_hold() * careful;
}

PartDecomposer::PartDecomposer(SlipPart part, bool is_tunable, bool behind_contact)
    : part_(std::move(part)), is_tunable_(is_tunable), behind_contact_(behind_contact) {
  for (std::size_t i = 0; i < part_.gated.size(); ++i) {
    Real& feedthrough = part_.gated[i].feedthrough_damping;
    feedthrough = snapped(feedthrough, regime(i).feedthrough());
    const Real whole = zero_frequency_damping(regime(i).form),
               left_out = whole - snapped(zero_frequency_damping(part_.gated[i]), whole);
    gated_brakes_.push_back(feedthrough + std::max(left_out, Real(0)));
  }
}

ComponentSplit PartDecomposer::split(const SlipPlan& plan, const PortDevice& device) const {
  ComponentSplit split{{}, {}, part_.regimes, {}, {}, plan.law, ""};
  for (const SlipLaw law : laws_to_choose_from) split.offers.push_back({law, refusal_of(law, plan, device)});
  split.reason =
      plan.law == SlipLaw::by_motor ? "the brake's damping does not change" : refusal_of(plan.law, plan, device);
  if (plan.law != SlipLaw::by_motor && !split.reason.empty()) split.law = SlipLaw::velocity_free;
  split.shares = shares(split.law, plan, device);
  return split;
}

const Real& PartDecomposer::largest_feedthrough() const {
  const std::vector<Regime>& all = part_.regimes.regimes;
  return std::max_element(all.begin(), all.end(),
                          [](const Regime& x, const Regime& y) { return x.feedthrough() < y.feedthrough(); })
      ->feedthrough();
}

// How much damping a regime's observer takes beyond the largest b∞ of all regimes, which the brake always keeps. 0
// while no slip slides: the excess would have to change as soon as one does.
double PartDecomposer::excess_of(std::size_t i) const {
  return i == 0 ? 0 : std::max(0.0, to_double(regime(i).damping - largest_feedthrough()));
}

double PartDecomposer::largest_excess() const {
  double largest = 0;
  for (std::size_t i = 0; i < part_.regimes.regimes.size(); ++i) largest = std::max(largest, excess_of(i));
  return largest;
}

// Why there is only one law; empty if there are several.
std::string PartDecomposer::hindrance_to_choice() const {
  if (is_tunable_) return "parameters change while it runs; b is that of their default values";
  return is_listed() ? "" : fmt::format("regimes of {} coupled slips are not listed", part_.regimes.slips.size());
}

std::string PartDecomposer::refusal_of(SlipLaw law, const SlipPlan& plan, const PortDevice& device) const {
  if (law == SlipLaw::velocity_free || law == SlipLaw::by_motor) return hindrance_to_choice();
  if (!hindrance_to_choice().empty()) return hindrance_to_choice();
  if (law == SlipLaw::gated)
    return part_.gated.empty() ? largest_excess() > 0 ? "no damper is in parallel with a slip"
                                                      : "while slips slide, no damper acts beyond those at the tool"
                               : "";
  if (largest_excess() <= 0) return "no sliding regime calls for more damping than the largest b∞";
  if (law == SlipLaw::steady) {
    if (behind_contact_) return "the brake is off while the tool is free, so that its damping cannot be constant";
    return std::isfinite(plan.estimate_gain)
               ? ""
               : fmt::format("no bound is known for the gain of the estimator '{}'", device.estimator_name());
  }
  if (!device.estimate_memory())
    return fmt::format("the estimator '{}' {}", device.estimator_name(),
                       device.divides_by_varying_interval() ? "divides by intervals that vary"
                                                            : "has an infinite impulse response or is not linear");
  return device.amplifier_lag() > 0 ? "the amplifier lags, and so has an infinite impulse response" : "";
}

std::vector<BrakeShare> PartDecomposer::shares(SlipLaw law, const SlipPlan& plan, const PortDevice& device) const {
  const std::size_t count = std::max<std::size_t>(part_.regimes.regimes.size(), 1);
  if (law == SlipLaw::by_motor) return std::vector<BrakeShare>(count);
  // b∞ of the regimes that are not listed is no less than that with all slips sliding.
  if (!is_listed()) return {{to_double(part_.sliding.feedthrough_damping), part_.sliding.feedthrough_damping, 0}};
  std::vector<BrakeShare> shares;
  for (std::size_t i = 0; i < count; ++i) shares.push_back(share(law, plan, device, i));
  return shares;
}

BrakeShare PartDecomposer::share(SlipLaw law, const SlipPlan& plan, const PortDevice& device, std::size_t i) const {
  const Real& feedthrough = regime(i).feedthrough();
  const double floor = to_double(largest_feedthrough());
  if (law == SlipLaw::gated) return {to_double(gated_brakes_[i]), part_.gated[i].feedthrough_damping, 0};
  if (law == SlipLaw::steady) {
    const double excess = plan.excess * largest_excess();
    return {floor + excess, feedthrough, compensated_share(device) / plan.estimate_gain * excess};
  }
  if (law == SlipLaw::ramped) return {floor + excess_of(i), feedthrough, compensated_share(device) * excess_of(i)};
  return {to_double(feedthrough), feedthrough, 0};
}

}  // namespace dashpot::compiler
