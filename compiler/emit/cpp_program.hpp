// An update law's programs as lines of C++: straight-line with the author's names for few states, rolled loops over
// structure-of-arrays coefficients for many.
#pragma once

#include <string>
#include <vector>

#include "discretise/update_law.hpp"

namespace dashpot::compiler {

struct CppProgram {
  std::vector<std::string> headers;    // of the runtime that the lines below need
  std::vector<std::string> functions;  // private helpers that the lines below call
  std::vector<std::string> constants;
  std::vector<std::string> states;
  std::vector<std::string> parameters; // the struct of that name
  std::vector<std::string> set;        // the function of that name, with its contract
  std::vector<std::string> reset;
  std::vector<std::string> output;
  std::string command;                 // what output() returns
  std::string safe_command;            // and after an input that is no number
  std::vector<std::string> keep;
  std::vector<std::string> update;
  std::vector<std::string> energy;
};

CppProgram cpp_program(const UpdateLaw& law, const Network& network);

// A double or float literal that reads back as the same number.
std::string cpp_literal(double value, ScalarType scalar);

}  // namespace dashpot::compiler
