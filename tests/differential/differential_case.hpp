// One random network through the whole compiler: its text, its law, a motion, and what evaluate() answers to it.
#pragma once

#include <string>
#include <vector>

#include "emit/emission.hpp"

namespace dashpot::testing {

enum class Family { linear_exact, linear_backward_euler, slips, contact };
std::string name_of(Family family);

struct Sample {
  double position;  // [m]
  double velocity;  // [m/s]
};

struct Answer {
  double damping;  // [N·s/m]
  double force;    // of the motor [N]
  double energy;   // [J]
};

struct DifferentialCase {
  std::string description;  // seed, choices and the network's text, for whoever repeats it
  compiler::Compilation compilation;
  std::vector<Sample> motion;     // numbers of the law's scalar type
  std::vector<Answer> evaluated;  // one a sample
};

// Seeds give every scheme, state input, decomposition, rate, scalar and kind of device in varying combinations; the
// names of classes are unique among seeds. Throws std::runtime_error where the compiler refuses the network.
DifferentialCase differential_case(Family family, std::uint64_t seed);

// Empty where the whole force of the law is that of its network, as an integrator has it that shares nothing with the
// compiler; laws that are not meant to be exact are not asked.
std::string departure_from_reference(const DifferentialCase& one);
bool has_reference(const DifferentialCase& one);

}  // namespace dashpot::testing
