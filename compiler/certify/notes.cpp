#include "certify/notes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "certify/choice_text.hpp"
#include "decompose/slip_laws.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

// A value of at most this share of the choice's is worth a note.
constexpr double worthwhile = 0.9;

using Eligible = bool (*)(const Candidate&, const Candidate&);

const Candidate* least(const Decomposition& decomposition, std::optional<double> Candidate::*figure,
                       Eligible eligible) {
  const Candidate* best = nullptr;
  for (const Candidate& candidate : decomposition.candidates)
    if (candidate.*figure && eligible(candidate, decomposition.choice()) &&
        (!best || *(candidate.*figure) < *(best->*figure)))
      best = &candidate;
  return best;
}

bool any(const Candidate&, const Candidate&) { return true; }

bool needs_no_more(const Candidate& candidate, const Candidate& choice) {
  return candidate.minimum_damping && choice.minimum_damping &&
         *candidate.minimum_damping <= *choice.minimum_damping * (1 + 1e-6);
}

// Without a device nothing errs. Behind slips another candidate may be given another law, which needs something else.
std::string price_of(const Candidate& other, const Decomposition& decomposition) {
  const Candidate& choice = decomposition.choice();
  const std::string alike = decomposition.slips.all().empty() ? "" : ", if the slip rules stay as they are chosen here";
  if (other.largest_error == 0 && choice.largest_error == 0) return alike;
  return fmt::format(", with a felt error of {} % instead of {} %{}", in_percent(other.largest_error),
                     in_percent(choice.largest_error), alike);
}

// A law behind slips that keeps the estimate's noise out of the motor, with its error in a run.
std::optional<std::string> quieter_law(const SlipDecomposition& slips) {
  const SlipLawMerit *chosen = nullptr, *quietest = nullptr;
  const std::vector<const ComponentSplit*> parts = slips.all();
  for (const SlipLawMerit& merit : slips.merits) {
    if (std::any_of(parts.begin(), parts.end(), [&](const ComponentSplit* part) { return part->law == merit.law; }) &&
        merit.law != SlipLaw::velocity_free)
      chosen = &merit;
    if (merit.error() <= slips.limit && merit.motor_noise && (!quietest || *merit.motor_noise < *quietest->motor_noise))
      quietest = &merit;
  }
  if (!chosen || !quietest || !chosen->motor_noise || !(*quietest->motor_noise < worthwhile * *chosen->motor_noise))
    return std::nullopt;
  return fmt::format(
      "the slip rule '{}' would reduce the motor's noise to {:.3g} %, with an error of {:.3g} % instead of {:.3g} %",
      name_of(quietest->law), 100 * *quietest->motor_noise / *chosen->motor_noise, 100 * quietest->error(),
      100 * chosen->error());
}

}  // namespace

std::vector<std::string> notes_on_choice(const Decomposition& decomposition, const Network& network) {
  std::vector<std::string> notes;
  if (has_tunables(network)) return notes;
  const Candidate& choice = decomposition.choice();
  const Candidate* calmest = least(decomposition, &Candidate::minimum_damping, any);
  if (calmest && choice.minimum_damping && *calmest->minimum_damping < worthwhile * *choice.minimum_damping)
    notes.push_back(fmt::format("'{}' would need {:.4g} in place of {:.4g} {} of minimum damping{}", calmest->name,
                                *calmest->minimum_damping, *choice.minimum_damping,
                                port_units(network.port_motion).damping, price_of(*calmest, decomposition)));
  const Candidate* quietest = least(decomposition, &Candidate::motor_noise, needs_no_more);
  if (quietest && choice.motor_noise && *quietest->motor_noise < worthwhile * *choice.motor_noise)
    notes.push_back(fmt::format("'{}' would need no more damping and reduce the motor's noise to {:.3g} %{}",
                                quietest->name, 100 * *quietest->motor_noise / *choice.motor_noise,
                                price_of(*quietest, decomposition)));
  if (const std::optional<std::string> note = quieter_law(decomposition.slips)) notes.push_back(*note);
  return notes;
}

}  // namespace dashpot::compiler
