// Networks that are compiled and run in two ways: as emitted code, and by `dashpot simulate`.
#pragma once

#include <string>
#include <vector>

#include "network/network.hpp"
#include "support/shell_command.hpp"

namespace dashpot::testing {

// What is compiled, for the command line.
struct Choice {
  double rate;                // [Hz]
  std::string options;        // without --rate and --scalar
  bool gives_velocity;        // the motion has a velocity of its own; else `simulate` takes the slope
  std::string emission = "";  // options of `compile` alone: they change no bit
};

// Every scheme, state input, decomposition and rate, in varying combinations.
std::vector<Choice> all_choices();

struct Case {
  compiler::Network network;
  Choice choice;
  std::string name() const { return network.name; }
};

// Compiles, builds and runs all cases in `folder` with `scalar` ("double" or "float"). One complaint a case, in order:
// empty where both ways agree in every bit of every column.
std::vector<std::string> complaints_about(const std::vector<Case>& cases, const std::string& scalar,
                                          const std::filesystem::path& folder);

}  // namespace dashpot::testing
