// What was chosen on a device, in words.
#pragma once

#include <string>

#include "decompose/decomposition.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {

// What a network has beside its slips: the error over frequency is computed for this part only.
enum class Beside { no_slips, linear, nothing };

// What `faithful` chose for.
struct ChosenFor {
  PortUnits units;
  double reach;                   // largest damping of the brake, behind a static curve where that is steepest [N·s/m]
  double steepest;                // the largest slope of the map of a static curve; else 1
  bool is_tunable;                // what is certified holds over the ranges of its parameters
  double zero_frequency_damping;  // Z_d(0) [N·s/m]
  double feedthrough_damping;     // b∞ [N·s/m]
  Beside beside;
};

// Sentences on `faithful`: its b, what it gains and costs against the paper's rule, how it moves over the device's
// assumed values, and where the brake has little to do, why. Empty for another choice, and without a device.
std::string choice_in_words(const Decomposition& decomposition, const ChosenFor& what);

// Which state input `faithful` came with.
std::string reason_for_faithful(const Candidate& chosen, const Network& network, const Choices& choices);

// The extra damping that a choice needs to be passive at any delay of the velocity estimate, as a clause.
std::string at_any_delay(const Candidate& choice, const std::string& unit);

// A share in per cent, without an exponent: "1346", "5.65".
std::string in_percent(double share);

}  // namespace dashpot::compiler
