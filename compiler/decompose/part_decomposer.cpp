#include "decompose/part_decomposer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "decompose/slip_laws.hpp"
#include "decompose/spectrum.hpp"

namespace dashpot::compiler {
namespace {

std::complex<double> impedance(const LinearForm& form, double w) {
  return viscous_impedance(form, w) + to_double(form.static_stiffness) / std::complex(0.0, w);
}

// What differs by rounding alone is the same.
Real snapped(const Real& value, const Real& to) { return abs(value - to) <= abs(to) * Real("1e-30") ? to : value; }

}  // namespace

PartDecomposer::PartDecomposer(SlipPart part, const LinearForm& beside, const PortDevice& device, bool is_tunable)
    : part_(std::move(part)), beside_(beside), device_(device), is_tunable_(is_tunable) {
  for (std::size_t i = 0; i < part_.gated.size(); ++i) {
    Real& feedthrough = part_.gated[i].feedthrough_damping;
    feedthrough = snapped(feedthrough, regime(i).feedthrough());
    const Real whole = zero_frequency_damping(regime(i).form),
               left_out = whole - snapped(zero_frequency_damping(part_.gated[i]), whole);
    gated_brakes_.push_back(feedthrough + std::max(left_out, Real(0)));
  }
}

ComponentSplit PartDecomposer::split(const std::variant<std::string, double>& decomposition) const {
  ComponentSplit split{{}, {}, part_.regimes, {}, {}, SlipLaw::by_motor, ""};
  for (SlipLaw law : {SlipLaw::velocity_free, SlipLaw::gated, SlipLaw::compensated}) split.merits.push_back(merit(law));
  choose(decomposition, split);
  split.shares = shares(split.law);
  return split;
}

// Where no slip slides nothing is gained by an observer: what it would take changes when one does.
double PartDecomposer::excess_brake(std::size_t i) const {
  return i == 0 ? 0 : to_double(regime(i).damping - regime(i).feedthrough());
}
double PartDecomposer::compensation(std::size_t i) const {
  return std::min(excess_brake(i), (1 - device_.tolerance()) * to_double(regime(i).damping));
}

double PartDecomposer::largest_excess_brake() const {
  double largest = 0;
  for (std::size_t i = 0; i < part_.regimes.regimes.size(); ++i) largest = std::max(largest, excess_brake(i));
  return largest;
}
double PartDecomposer::largest_compensation() const {
  double largest = 0;
  for (std::size_t i = 0; i < part_.regimes.regimes.size(); ++i) largest = std::max(largest, compensation(i));
  return largest;
}

void PartDecomposer::choose(const std::variant<std::string, double>& decomposition, ComponentSplit& split) const {
  const auto* name = std::get_if<std::string>(&decomposition);
  if (name == nullptr || *name == "virtual") {
    split.reason = "the brake's damping does not change";
  } else if (!hindrance_to_choice().empty()) {
    take(SlipLaw::velocity_free, hindrance_to_choice(), split);
  } else if (*name == "most-dissipative") {
    choose_most_dissipative(split);
  } else {
    take(*name == name_of(SlipLaw::gated)         ? SlipLaw::gated
         : *name == name_of(SlipLaw::compensated) ? SlipLaw::compensated
                                                  : SlipLaw::velocity_free,
         "asked for", split);
  }
}

// Why there is but one law; empty where there are several.
std::string PartDecomposer::hindrance_to_choice() const {
  if (is_tunable_) return "parameters change while it runs; b is that of their default values";
  return is_listed() ? "" : fmt::format("regimes of {} coupled slips are not listed", part_.regimes.slips.size());
}

void PartDecomposer::choose_most_dissipative(ComponentSplit& split) const {
  const SlipLawMerit &gated = split.merits[1], &compensated = split.merits[2];
  const std::string error = gated.refusal.empty()
                                ? fmt::format("the gated law errs by {:.3g} % in the band", 100 * gated.largest_error)
                                : gated.refusal;
  if (gated.refusal.empty() && gated.largest_error <= gated_tolerance)
    return take(SlipLaw::gated, fmt::format("{}, no more than {:.3g} %", error, 100 * gated_tolerance), split);
  if (gated.refusal.empty() && compensated.refusal.empty()) return take(SlipLaw::compensated, error, split);
  take(SlipLaw::velocity_free, gated.refusal.empty() ? error + ", and " + compensated.refusal : error, split);
}

void PartDecomposer::take(SlipLaw law, std::string reason, ComponentSplit& split) const {
  const auto chosen = std::find_if(split.merits.begin(), split.merits.end(),
                                   [=](const SlipLawMerit& merit) { return merit.law == law; });
  split.law = chosen->refusal.empty() ? law : SlipLaw::velocity_free;
  split.reason = chosen->refusal.empty() ? std::move(reason) : chosen->refusal;
}

std::string PartDecomposer::refusal_of(SlipLaw law) const {
  if (law == SlipLaw::velocity_free) return "";
  if (!hindrance_to_choice().empty()) return hindrance_to_choice();
  if (largest_excess_brake() <= 0) return "what slides has no damping but at the tool";
  if (law == SlipLaw::gated) return part_.gated.empty() ? "no damper lies beside a slip" : "";
  if (!device_.estimate_memory())
    return fmt::format("the estimator '{}' never forgets or is not linear", device_.estimator_name());
  return "";
}

SlipLawMerit PartDecomposer::merit(SlipLaw law) const {
  SlipLawMerit merit{law, 0, 0.0, refusal_of(law)};
  if (!merit.refusal.empty() || law == SlipLaw::velocity_free) return merit;
  for (std::size_t i = 0; i < part_.regimes.regimes.size(); ++i)
    merit.largest_error =
        std::max(merit.largest_error, largest_in_band(device_, [&](double w) { return error(law, i, w); }));
  if (law != SlipLaw::compensated) return merit;
  const std::optional<double> noise = device_.velocity_noise();
  merit.motor_noise = noise ? std::optional(largest_compensation() * *noise) : std::nullopt;
  return merit;
}

double PartDecomposer::error(SlipLaw law, std::size_t i, double w) const {
  const LinearForm& form = regime(i).form;
  const std::complex<double> whole = impedance(beside_, w) + impedance(form, w);
  const std::complex<double> error = law == SlipLaw::gated
                                         ? to_double(gated_brakes_[i]) + impedance(part_.gated[i], w) -
                                               to_double(part_.gated[i].feedthrough_damping) - impedance(form, w)
                                         : excess_brake(i) - compensation(i) * device_.velocity_response(w);
  return std::abs(error) == 0 ? 0 : std::abs(error) / std::abs(whole);
}

std::vector<BrakeShare> PartDecomposer::shares(SlipLaw law) const {
  const std::size_t count = std::max<std::size_t>(part_.regimes.regimes.size(), 1);
  if (law == SlipLaw::by_motor) return std::vector<BrakeShare>(count);
  // b∞ of the regimes that are not listed is no less than that with all slips sliding.
  if (!is_listed()) return {{to_double(part_.sliding.feedthrough_damping), part_.sliding.feedthrough_damping, 0}};
  std::vector<BrakeShare> shares;
  for (std::size_t i = 0; i < count; ++i) shares.push_back(share(law, i));
  return shares;
}

BrakeShare PartDecomposer::share(SlipLaw law, std::size_t i) const {
  const Real& feedthrough = regime(i).feedthrough();
  if (law == SlipLaw::gated) return {to_double(gated_brakes_[i]), part_.gated[i].feedthrough_damping, 0};
  if (law == SlipLaw::compensated && excess_brake(i) > 0)
    return {to_double(regime(i).damping), feedthrough, compensation(i)};
  return {to_double(feedthrough), feedthrough, 0};
}

}  // namespace dashpot::compiler
