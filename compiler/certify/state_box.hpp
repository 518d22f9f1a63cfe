// A box of states that a law does not leave while the inputs stay in a range. An emitted header in C states it; the
// proofs in tests/prove start from it and show that a step does not leave it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "decompose/port_device.hpp"
#include "law/update_law.hpp"

namespace dashpot::compiler {

// The largest |position| and |velocity| that the law gets.
struct InputRange {
  double position;  // [m]
  double velocity;  // [m/s]
};

// What the encoder can read and follow, at the port; where the device states no limit, 10 m and 100 m/s, or rad, which
// is more than a hand moves.
InputRange input_range(const PortDevice& port);

// A force F whose rounding error e is carried along: bounds are those of F + e.
struct CarriedError {
  VariableId force, error;
  VariableId added;  // y, which includes e, in an update: F ← F + y
};
std::vector<CarriedError> carried_errors(const UpdateLaw& law);

// The name of a state in the emitted class.
std::string state_name(const Variable& state, std::size_t place);

// Bounds of a state, or of a state less factor times other states.
struct StateBounds {
  double low, high;
  std::vector<std::pair<std::string, double>> others = {};  // by state_name()
  double magnitude() const { return high > -low ? high : -low; }
};
using StateBox = std::map<std::string, StateBounds>;

// The least and the greatest value of every state, by state_name(), when the law starts at rest; empty if no bounds are
// found even with cases told apart, and for tunables. A little wider than the fixed point, so that the rounding of a
// step stays within.
std::optional<StateBox> state_box(const UpdateLaw& law, const InputRange& range);

// Bound of the sum of the magnitudes of the force's terms, in the box [N].
double sum_of_terms(const UpdateLaw& law, const InputRange& range, const StateBox& box);

}  // namespace dashpot::compiler
