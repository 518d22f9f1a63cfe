#include "decompose/slip_laws.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

bool is_like(const ComponentSplit& first, const ComponentSplit& second) {
  const auto same = [](const BrakeShare& x, const BrakeShare& y) {
    return x.damping == y.damping && x.feedthrough == y.feedthrough && x.compensation == y.compensation;
  };
  return first.law == second.law && first.reason == second.reason &&
         std::equal(first.shares.begin(), first.shares.end(), second.shares.begin(), second.shares.end(), same);
}

bool asks_the_brake(const ComponentSplit& split) {
  return std::any_of(split.regimes.regimes.begin(), split.regimes.regimes.end(),
                     [](const Regime& regime) { return regime.damping > 0; });
}

std::string regimes_text(const ComponentSplit& split, const Network& network) {
  const std::string unit = port_units(network.port_motion).damping;
  std::string text =
      fmt::format("  {:<24}{:>14}{:>16}{:>14}{:>14}  rule\n", "stuck", "b", "b of the rule", "b∞", "compensation");
  text += fmt::format("  {:<24}{:>14}{:>16}{:>14}{:>14}\n", "", unit, unit, unit, unit);
  for (std::size_t i = 0; i < split.regimes.regimes.size(); ++i) {
    const Regime& regime = split.regimes.regimes[i];
    const std::vector<std::string> stuck = slip_names(split.regimes, regime, false, network);
    text += fmt::format("  {:<24}{:>14.8g}{:>16.8g}{:>14.8g}{:>14.8g}  {}\n",
                        stuck.empty() ? "none" : fmt::format("{}", fmt::join(stuck, ", ")), split.shares[i].damping,
                        to_double(regime.damping), to_double(regime.feedthrough()), split.shares[i].compensation,
                        regime.reason);
  }
  return text;
}

std::string refusals_text(const ComponentSplit& split) {
  std::string text;
  for (const SlipLawOffer& offer : split.offers)
    if (!offer.refusal.empty() && offer.law != SlipLaw::velocity_free)
      text += fmt::format("  {} is not available: {}\n", name_of(offer.law), offer.refusal);
  return text;
}

// A table of how each law does in runs of the whole network.
std::string merits_text(const SlipDecomposition& slips, const Network& network) {
  if (slips.merits.empty()) return "";
  const PortUnits units = port_units(network.port_motion);
  const auto row = [](const auto&... cells) {
    return fmt::format("  {:<14}{:>12}{:>11}{:>12}{:>17}{:>11}{:>13}\n", cells...);
  };
  std::string text = fmt::format(
      "slip rules in test motions that make the slips yield{}: sines at both ends of the band, no slower than "
      "rate/1200 and no faster than rate/4, and a drag with reversals\n",
      has_tunables(network) ? ", with the parameters' values in the file" : "");
  text += row("slip rule", "peak error", "rms error", "mean brake", "minimum damping", "certified", "motor noise");
  text += row("", "%", "%", units.damping, units.damping, "", units.force);
  for (const SlipLawMerit& merit : slips.merits)
    text +=
        row(name_of(merit.law), fmt::format("{:.4g}", 100 * merit.peak_error),
            fmt::format("{:.4g}", 100 * merit.rms_error), fmt::format("{:.4g}", merit.mean_damping),
            merit.minimum_damping ? fmt::format("{:.4g}", *merit.minimum_damping) : "-", merit.certified ? "yes" : "no",
            merit.motor_noise ? fmt::format("{:.4g}", *merit.motor_noise) : "not linear");
  return text;
}

}  // namespace

std::string_view name_of(SlipLaw law) {
  switch (law) {
    case SlipLaw::by_motor: return "by-motor";
    case SlipLaw::velocity_free: return "velocity-free";
    case SlipLaw::steady: return "steady";
    case SlipLaw::ramped: return "ramped";
    case SlipLaw::gated: return "gated";
  }
  return "";
}

std::vector<std::string> slip_names(const RegimeList& list, const Regime& regime, bool sliding,
                                    const Network& network) {
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
  for (const ComponentSplit* split : slips.all()) {
    const auto like =
        std::find_if(all.begin(), all.end(), [&](const SlipLikes& other) { return is_like(*other.first, *split); });
    if (like == all.end()) all.push_back({split, {name_of(*split, network)}});
    else like->names.push_back(name_of(*split, network));
  }
  return all;
}

std::string to_text(const SlipLikes& likes) {
  const std::size_t shown = std::min<std::size_t>(likes.names.size(), 4);
  std::string names;
  for (std::size_t i = 0; i < shown; ++i) names += (i == 0 ? "" : "; ") + likes.names[i];
  if (shown < likes.names.size()) names += fmt::format(" and {} more", likes.names.size() - shown);
  return fmt::format("slip rule of {}: {}, {}", names, name_of(likes.first->law), likes.first->reason);
}

std::string to_text(const SlipDecomposition& slips, const Network& network) {
  std::string text;
  for (const SlipLikes& likes : likes_of(slips, network)) {
    text += fmt::format("{}\n", to_text(likes));
    const bool is_silent = std::all_of(likes.first->shares.begin(), likes.first->shares.end(),
                                       [](const BrakeShare& share) { return share.damping == 0; });
    text += fmt::format("  {} regimes{}{}\n", likes.first->regimes.count, likes.names.size() > 1 ? " each" : "",
                        is_silent && !asks_the_brake(*likes.first)
                            ? ", and the brake makes no damping of this part in any of them"
                            : "");
    if (asks_the_brake(*likes.first)) text += regimes_text(*likes.first, network);
    if (likes.first->regimes.regimes.empty() && likes.first->shares.front().damping > 0)
      text += fmt::format("  b = {:.8g} in every regime\n", likes.first->shares.front().damping);
    if (asks_the_brake(*likes.first)) text += refusals_text(*likes.first);
  }
  return text + merits_text(slips, network);
}

}  // namespace dashpot::compiler
