// A box of states that a law does not leave: what the proofs start from, and what they prove again in each step.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "law/update_law.hpp"

namespace dashpot::testing {

// What goes in: |position| and |velocity| at most.
struct InputRange {
  double position;  // [m]
  double velocity;  // [m/s]
};

// The greatest magnitude of every state, by emitted name, when the law starts at rest; empty where magnitudes alone
// show none. A little wider than the fixed point, so that the rounding of a step stays within.
std::optional<std::map<std::string, double>> state_box(const compiler::UpdateLaw& law, const InputRange& range);

// The sum of the magnitudes of the terms that the force is made of, in the box [N].
double sum_of_terms(const compiler::UpdateLaw& law, const InputRange& range, const std::map<std::string, double>& box);

}  // namespace dashpot::testing
