#include "certify/notes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "decompose/slip_laws.hpp"

namespace dashpot::compiler {
namespace {

// At most this share is worth a note.
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

// A law that would keep the noise of the estimate out of the motor, with its error.
std::optional<std::string> quieter_law(const ComponentSplit& split) {
  const SlipLawMerit* chosen = nullptr;
  for (const SlipLawMerit& merit : split.merits)
    if (merit.law == split.law) chosen = &merit;
  if (!chosen || !chosen->motor_noise) return std::nullopt;
  for (const SlipLawMerit& merit : split.merits)
    if (merit.refusal.empty() && merit.motor_noise && *merit.motor_noise < worthwhile * *chosen->motor_noise)
      return fmt::format(
          "behind slips '{}' would bring {:.3g} % of the motor's noise, and err by {:.3g} % in place of {:.3g} %",
          name_of(merit.law), 100 * *merit.motor_noise / *chosen->motor_noise, 100 * merit.largest_error,
          100 * chosen->largest_error);
  return std::nullopt;
}

}  // namespace

std::vector<std::string> notes_on_choice(const Decomposition& decomposition, const std::string& damping_unit) {
  std::vector<std::string> notes;
  const Candidate& choice = decomposition.choice();
  const Candidate* calmest = least(decomposition, &Candidate::minimum_damping, any);
  if (calmest && choice.minimum_damping && *calmest->minimum_damping < worthwhile * *choice.minimum_damping)
    notes.push_back(fmt::format("'{}' would need {:.4g} in place of {:.4g} {} of minimum damping", calmest->name,
                                *calmest->minimum_damping, *choice.minimum_damping, damping_unit));
  const Candidate* quietest = least(decomposition, &Candidate::motor_noise, needs_no_more);
  if (quietest && choice.motor_noise && *quietest->motor_noise < worthwhile * *choice.motor_noise)
    notes.push_back(fmt::format("'{}' would need no more damping and bring {:.3g} % of the motor's noise",
                                quietest->name, 100 * *quietest->motor_noise / *choice.motor_noise));
  for (const ComponentSplit* split : decomposition.slips.all())
    if (const auto note = quieter_law(*split); note && std::find(notes.begin(), notes.end(), *note) == notes.end())
      notes.push_back(*note);
  return notes;
}

}  // namespace dashpot::compiler
