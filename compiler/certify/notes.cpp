#include "certify/notes.hpp"

#include <fmt/format.h>

namespace dashpot::compiler {
namespace {

// At most this share is worth a note.
constexpr double worthwhile = 0.9;

const Candidate* least(const Decomposition& decomposition, std::optional<double> Candidate::*figure, bool (*eligible)(const Candidate&, const Candidate&)) {
  const Candidate* best = nullptr;
  for (const Candidate& candidate : decomposition.candidates)
    if (candidate.*figure && eligible(candidate, decomposition.choice()) && (!best || *(candidate.*figure) < *(best->*figure)))
      best = &candidate;
  return best;
}

bool any(const Candidate&, const Candidate&) { return true; }

bool needs_no_more(const Candidate& candidate, const Candidate& choice) {
  return candidate.minimum_damping && choice.minimum_damping && *candidate.minimum_damping <= *choice.minimum_damping * (1 + 1e-6);
}

}  // namespace

std::vector<std::string> notes_on_choice(const Decomposition& decomposition) {
  std::vector<std::string> notes;
  const Candidate& choice = decomposition.choice();
  const Candidate* calmest = least(decomposition, &Candidate::minimum_damping, any);
  if (calmest && choice.minimum_damping && *calmest->minimum_damping < worthwhile * *choice.minimum_damping)
    notes.push_back(fmt::format("'{}' would need {:.4g} in place of {:.4g} of minimum damping", calmest->name,
                                *calmest->minimum_damping, *choice.minimum_damping));
  const Candidate* quietest = least(decomposition, &Candidate::motor_noise, needs_no_more);
  if (quietest && choice.motor_noise && *quietest->motor_noise < worthwhile * *choice.motor_noise)
    notes.push_back(fmt::format("'{}' would need no more damping and bring {:.3g} % of the motor's noise", quietest->name,
                                100 * *quietest->motor_noise / *choice.motor_noise));
  return notes;
}

}  // namespace dashpot::compiler
