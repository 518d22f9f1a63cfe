// A box of states that a law does not leave while the inputs keep to a range. An emitted header in C states it; the
// proofs in tests/prove start from it, and prove it again in each step.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "decompose/port_device.hpp"
#include "law/update_law.hpp"

namespace dashpot::compiler {

// What goes in: |position| and |velocity| at most.
struct InputRange {
  double position;  // [m]
  double velocity;  // [m/s]
};

// What the encoder can read and follow, at the port; where the device states no limit, 10 m and 100 m/s, or rad, which
// is more than a hand moves.
InputRange input_range(const PortDevice& port);

// As the class calls it.
std::string state_name(const Variable& state, std::size_t place);

// The greatest magnitude of every state, by state_name(), when the law starts at rest; empty where magnitudes show none
// though cases are told apart, as of slips that meet at inner nodes and of tunables. A little wider than the fixed
// point, so that the rounding of a step stays within.
std::optional<std::map<std::string, double>> state_box(const UpdateLaw& law, const InputRange& range);

// The sum of the magnitudes of the terms that the force is made of, in the box [N].
double sum_of_terms(const UpdateLaw& law, const InputRange& range, const std::map<std::string, double>& box);

}  // namespace dashpot::compiler
