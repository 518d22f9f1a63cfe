// The constants of a law of several ports, port by port, as the port's own law calls them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verify/verify_header.hpp"

namespace dashpot::compiler {

// A port as it has been compiled again, with its law before it became part of the law of all.
struct VerifiedPort {
  std::string name;
  const Compilation* compiled;
  const UpdateLaw* law;
  Choices choices;
  std::vector<HeaderConstant> constants = {};  // of the header, as the port's law calls them
};

// Gives a constant of the header to the port that `law`, that of all ports, has it from. False if it is of no port.
bool give_to_port(const HeaderConstant& constant, const UpdateLaw& law, std::vector<VerifiedPort>& ports);

// Computes all constants of the port anew, and reports every disagreement.
void recompute_port(const VerifiedPort& port, ScalarType scalar, Diagnostics& diagnostics);

// Reports a constant that the law, written again, has not got.
void compare_with_written(const HeaderConstant& constant, const UpdateLaw& law, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
