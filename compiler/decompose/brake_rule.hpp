// What the brake's damping follows while the parameters of a network change.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "decompose/decomposition.hpp"
#include "decompose/port_device.hpp"
#include "law/tunable_tables.hpp"

namespace dashpot::compiler {

struct BrakeRule {
  BrakeFollows follows;
  double damping;  // the constant, if the rule has one [N·s/m]
  std::vector<std::size_t>
      observed;  // for BrakeFollows::observed: the dampers whose sum is b, as indices into Network::elements
  std::optional<double> max_damping;  // what the brake can give [N·s/m]
  std::string text;                   // one clause for people
};

// In: the linear part of a network at its default values, and what was chosen for it. Out: the same choice as a rule
// for all values. Ensures: the rule gives the chosen damping at the default values, within rounding, and never less
// than zero.
BrakeRule brake_rule_of(const Network& network, const Decomposition& decomposition, const PortDevice& device);

}  // namespace dashpot::compiler
