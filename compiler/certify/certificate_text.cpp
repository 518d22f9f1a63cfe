#include <fmt/format.h>

#include <cmath>

#include "certify/certificate.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

std::string covered(const Certificate& c) {
  std::string regimes = c.bound.any_regime ? ", whatever slides, sticks, touches or lets go" : "";
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
  return "any motion" + regimes + jitter + ", any damping of the brake that is not below " +
         (changes && c.loop.has_device ? "what the device makes of its commands" : "its command");
}

std::string requirement(const Certificate& c, const std::string& unit) {
  const std::string most = c.bound.frequency > 0 ? fmt::format(", most at {:.6g} Hz", c.bound.frequency) : "";
  const bool by_sample = c.bound.proof == Proof::hold;
  const std::string hold = by_sample || c.loop.jitter > 0
                               ? fmt::format("{} over a hold of up to {:.6g} s",
                                             by_sample ? ", counted sample by sample" : "", c.loop.longest_hold())
                               : "";
  return fmt::format("needs {:.6g} {}{}{}", c.bound.needed, unit, hold, most);
}

std::string verdict(const Certificate& c, const std::string& unit) {
  if (c.bound.proof == Proof::none && c.bound.needed > 0)
    return fmt::format("not certified: {}; {:.6g} {} of damping are needed, at least {:.6g} is there", c.bound.reason,
                       c.bound.needed, unit, c.assured);
  if (c.bound.proof == Proof::none) return "not certified: " + c.bound.reason;
  const std::string numbers = fmt::format("{}, at least {:.6g} {} is there", requirement(c, unit), c.assured, unit);
  if (c.certified)
    return fmt::format("{}{} {}: {}", grade_of(c), c.bound.constant_period_only ? ":" : " for", covered(c), numbers);
  const double missing = c.minimum_damping - c.added_damping;
  const double sure = assured_share(c.loop).convert_to<double>();
  const std::string of_it = sure < 1 ? fmt::format(": of a command no more than {:.4g} is sure{}", sure,
                                                   c.loop.critical_speed > 0 ? " at the largest speed" : "")
                                     : "";
  return fmt::format("not certified for {}: {}, {:.6g} {} more is missing in the brake's command{}", covered(c),
                     numbers, missing, unit, of_it);
}

// Compares K with 2 f_c/Δ, the most that friction pays for, and says how much energy is left beyond it.
std::string quantisation_text(const Certificate& c, const PortUnits& units) {
  std::string text =
      c.quantisation_gain
          ? fmt::format(
                "quantisation: in the motor the encoder's steps act like a spring of at most {:.6g} {} that gives "
                "energy; ",
                *c.quantisation_gain, units.stiffness)
          : std::string("quantisation: the energy that the encoder's steps bring in by the motor is not bounded; ");
  if (c.quantisation_stiffness > 0)
    text += fmt::format(
        "the device's Coulomb friction f_c takes that of a spring of up to 2 f_c/step = {:.6g} {}, a brake none of it",
        c.quantisation_stiffness, units.stiffness);
  else text += "the device file states no Coulomb friction, which would take it; a brake does not";
  if (unpaid_force(c) > 0)
    text +=
        fmt::format("; what is beyond can give the hand {:.3g} J per {} of travel", unpaid_force(c), units.position);
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
        "  of the brake's command {:.6g} {} are for passivity and not compensated: what is rendered is D + {:.6g} s",
        c.added_damping, unit, c.added_damping));
  if (c.certified && c.loop.encoder_step > 0)
    lines.push_back(
        "  the proof takes the position for exact: the energy that the encoder's steps add is not part of it; 'dashpot "
        "explain' states it under quantisation");
  if (!c.energy.applies) return lines;
  std::string energy = "energy: ";
  if (!c.energy.holds)
    energy += fmt::format(
        "the law may give more than it stores: up to {:.3g} N/m times the square of the travel in each sample",
        c.energy.shortfall);
  else if (c.energy.over_box)
    energy +=
        "whatever the values within their ranges, no motion gets more work out of the law than stored_energy() falls";
  else if (c.energy.with_slips)
    energy +=
        "no motion gets more work out of any part than the part has stored, and slips and contacts only take energy";
  else if (c.energy.storage == EnergyStorage::emitted)
    energy += "no motion gets more work out of the law than stored_energy() falls";
  else
    energy += fmt::format(
        "no motion gets more work out of the law than is stored, which in {} modes is counted with the weight 1/(2 a "
        "d)",
        c.energy.reweighted_modes);
  lines.push_back(
      energy + fmt::format("; rounding adds at most {:.2g} of the sum of the force's terms", c.energy.rounding_share));
  return lines;
}

std::string why_not_certified(const Certificate& c, motion port_motion) {
  const std::string unit = port_units(port_motion).damping;
  const double missing = c.bound.needed - c.assured;
  const std::string numbers =
      fmt::format("{:.6g} {} of damping are needed, at least {:.6g} is there, {:.6g} is missing", c.bound.needed, unit,
                  c.assured, missing);
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
