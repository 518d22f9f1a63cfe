// What the command line asks for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "decompose/choices.hpp"
#include "emit/emission.hpp"

namespace dashpot::compiler {

enum class ExitStatus { done = 0, input_refused = 1, command_line_wrong = 2, defect = 3 };

struct Options {
  std::vector<std::string> networks;
  std::optional<std::string> device;
  Choices choices;
  std::optional<std::string> output;  // folder of compile, file of simulate
  std::string input;                  // simulate: the motion
  std::optional<std::string> print;   // compile: the stage to show instead of writing
  std::optional<std::string> depfile;
  EmissionOptions emission;
  bool json = false;              // explain
  bool json_diagnostics = false;
};

}  // namespace dashpot::compiler
