#include <fmt/format.h>

#include <cmath>

#include "certify/certificate.hpp"
#include "network/port_units.hpp"
#include "source/counted.hpp"

namespace dashpot::compiler {
namespace {

std::string covered(const Certificate& c) {
  std::string regimes =
      c.bound.any_regime ? ", whichever slips slide or stick and whether the tool touches or not" : "";
  if (c.bound.any_value)
    regimes += std::string(", any values within their ranges") +
               (c.bound.over_changes ? " and any changes of them" : " between changes");
  if (c.bound.constant_period_only)
    return fmt::format("any motion{}, samples at {:.6g} Hz", regimes, 1 / c.loop.sample_period);
  std::string jitter = c.loop.jitter > 0 ? fmt::format(", any jitter up to {:.4g} s", c.loop.jitter) : "";
  if (c.loop.write_latest > 0)
    jitter += fmt::format(", commands that act up to {:.4g} s after their samples", c.loop.write_latest);
  if (c.bound.proof == Proof::sampled)
    return fmt::format("any motion{}, samples at {:.6g} Hz{}", regimes, 1 / c.loop.sample_period, jitter);
  const bool changes = c.bound.any_regime || c.bound.any_value;
  return "any motion" + regimes + jitter + ", any brake that makes at least " +
         (changes && c.loop.has_device ? "what the device file guarantees of its commands" : "the commanded damping");
}

std::string requirement(const Certificate& c, const std::string& unit) {
  const std::string most = c.bound.frequency > 0 ? fmt::format(", the most at {:.6g} Hz", c.bound.frequency) : "";
  const bool by_sample = c.bound.proof == Proof::hold;
  const std::string hold =
      by_sample || c.loop.jitter > 0
          ? fmt::format(" {} commands that are held for up to {:.6g} s",
                        by_sample ? "by a proof sample by sample, for" : "for", c.loop.longest_hold())
          : "";
  return fmt::format("needs {:.6g} {}{}{}", c.bound.needed, unit, hold, most);
}

std::string verdict(const Certificate& c, const std::string& unit) {
  if (c.bound.proof == Proof::none && c.bound.needed > 0)
    return fmt::format("not certified: {}; {:.6g} {} of damping are needed, {:.6g} is guaranteed", c.bound.reason,
                       c.bound.needed, unit, c.assured);
  if (c.bound.proof == Proof::none) return "not certified: " + c.bound.reason;
  const std::string numbers = fmt::format("{}; {:.6g} {} is guaranteed", requirement(c, unit), c.assured, unit);
  if (c.certified)
    return fmt::format("{}{} {}: {}", grade_of(c), c.bound.constant_period_only ? ":" : " for", covered(c), numbers);
  const double missing = c.minimum_damping - c.added_damping;
  const double sure = assured_share(c.loop).convert_to<double>();
  const std::string of_it = sure < 1 ? fmt::format(", of which only the share {:.4g} is guaranteed{}", sure,
                                                   c.loop.critical_speed > 0 ? " at the largest speed" : "")
                                     : "";
  return fmt::format(
      "not certified: to be passive for {}, the law {}; the brake's command would have to be {:.6g} {} larger{}",
      covered(c), numbers, missing, unit, of_it);
}

// Compares K with 2 f_c/Δ, the most that friction pays for, and says how much energy is left beyond it.
std::string quantisation_text(const Certificate& c, const PortUnits& units) {
  std::string text =
      c.quantisation_gain
          ? fmt::format(
                "quantisation: the encoder's steps can make the motor inject energy, like a spring of at most {:.6g} "
                "{}; ",
                *c.quantisation_gain, units.stiffness)
          : std::string("quantisation: the energy that the encoder's steps make the motor inject is not bounded; ");
  if (c.quantisation_stiffness > 0)
    text += fmt::format(
        "the device's Coulomb friction f_c dissipates that of a spring of up to 2 f_c/step = {:.6g} {}; a brake "
        "dissipates none of it",
        c.quantisation_stiffness, units.stiffness);
  else text += "the device file states no Coulomb friction, which would dissipate it; a brake does not";
  if (unpaid_force(c) > 0)
    text += fmt::format("; the rest can give the hand {:.3g} J per {} of travel", unpaid_force(c), units.position);
  return text + "\n";
}

}  // namespace

std::vector<std::string> passivity_lines(const Certificate& c, const std::string& unit) {
  std::vector<std::string> lines = {"passivity: " + verdict(c, unit)};
  if (!c.loop.has_device)
    lines.push_back(
        "  without a device an ideal one is assumed, with the difference of two samples for the velocity, and no "
        "damping is added for passivity");
  if (c.added_damping > 0)
    lines.push_back(fmt::format(
        "  {:.6g} {} of the brake's command are for passivity; the motor does not cancel them, so that they are felt "
        "in addition to the network",
        c.added_damping, unit));
  if (c.certified && c.loop.encoder_step > 0)
    lines.push_back(
        "  the proof takes the position to be exact, without the energy that the encoder's steps inject; 'dashpot "
        "explain' states that under quantisation");
  if (!c.energy.applies) return lines;
  std::string energy = "energy: ";
  if (!c.energy.holds)
    energy += fmt::format(
        "the law may give out more energy than it stores: up to {:.3g} N/m times the square of the travel in each "
        "sample",
        c.energy.shortfall);
  else if (c.energy.over_box)
    energy +=
        "over any motion, and for any values within their ranges, the law gives out no more work than stored_energy() "
        "decreases by";
  else if (c.energy.with_slips)
    energy +=
        "over any motion no part gives out more work than it has stored, and slips and contacts only dissipate energy";
  else if (c.energy.storage == EnergyStorage::emitted)
    energy += "over any motion the law gives out no more work than stored_energy() decreases by";
  else
    energy += fmt::format(
        "over any motion the law gives out no more work than it has stored; in {} the stored energy is counted with "
        "the weight 1/(2 a d) [see compiler/theory.md]",
        counted(c.energy.reweighted_modes, "mode"));
  lines.push_back(energy +
                  fmt::format("; rounding changes the force by at most {:.2g} of the sum of its terms' magnitudes",
                              c.energy.rounding_share));
  return lines;
}

std::string why_not_certified(const Certificate& c, motion port_motion) {
  const std::string unit = port_units(port_motion).damping;
  const double missing = c.bound.needed - c.assured;
  const std::string numbers = fmt::format("{:.6g} {} of damping are needed, {:.6g} is guaranteed, {:.6g} is missing",
                                          c.bound.needed, unit, c.assured, missing);
  if (c.bound.proof != Proof::none) return numbers;
  return c.bound.needed > 0 ? c.bound.reason + "; " + numbers : c.bound.reason;
}

std::string to_text(const Certificate& c, motion port_motion) {
  const PortUnits units = port_units(port_motion);
  std::string text;
  for (const std::string& line : passivity_lines(c, units.damping)) text += line + "\n";
  for (const std::string& line : to_lines(c.limits, c.loop, units)) text += line + "\n";
  return c.loop.encoder_step > 0 ? text + quantisation_text(c, units) : text;
}

}  // namespace dashpot::compiler
