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
  std::vector<HeaderConstant> constants = {};  // of the header, without the port's name
};

// The port with whose name the constant's begins, and whose law has one that is called like the rest; of several such,
// or where none has, the longest name. Empty where none begins it.
std::optional<std::size_t> port_of(const std::string& constant, const std::vector<VerifiedPort>& ports);

// Gives the port a constant of the header. What keeps apart what would be called alike is no part of the port's names.
void give(const HeaderConstant& constant, VerifiedPort& port);

// Computes all constants of the port anew, and reports every disagreement.
void recompute_port(const VerifiedPort& port, ScalarType scalar, Diagnostics& diagnostics);

// Reports literals that no state of the law rests at.
void look_at_literals(const HeaderConstant& literals, const UpdateLaw& law, Diagnostics& diagnostics);

// Reports a constant that the law, written again, has not got.
void compare_with_written(const HeaderConstant& constant, const UpdateLaw& law, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
