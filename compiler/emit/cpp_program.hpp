// An update law's programs as lines of C++: straight-line with the author's names for few states, rolled loops over
// structure-of-arrays coefficients for many.
#pragma once

#include <string>
#include <vector>

#include "emit/code_model.hpp"
#include "law/update_law.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

struct CppProgram {
  std::vector<std::string> headers;    // of the runtime that the lines below need
  std::vector<std::string> functions;  // private helpers that the lines below call
  std::vector<std::string> constants;
  std::vector<std::string> states;
  std::vector<std::string> set;  // behind the parameters' new values
  std::string kept_share;        // empty where nothing is shed
  std::vector<std::string> reset;
  std::vector<std::string> output;
  std::vector<std::string> check;  // whether the sample is one that can be kept
  std::vector<std::string> keep;
  std::string command;            // what output() returns
  std::vector<std::string> wait;  // what begins update(): nothing happens without such a sample
  std::vector<std::string> update;
  std::vector<std::string> step;  // both phases in one
  std::vector<std::string> energy;
};

// Whether the code may branch, which costs nothing if branches are predicted, or takes the same time for all values.
enum class Timing { any, constant };

// Loops are laid out for these registers. In constant time: laws without couplings and networks.
CppProgram cpp_program(const UpdateLaw& law, const Network& network, VectorRegisters registers,
                       Timing timing = Timing::any);

// Of the runtime, that the law's code calls: "dashpot/command.hpp".
std::vector<std::string> headers_of(const UpdateLaw& law);

// All of it but `set`, as templates take it, under the names of its members.
void add_program(const CppProgram& program, CodeModel& model);

// A line for each place of the coefficient; of a table that is picked from, the array.
void append_constant_of_each(const Coefficient& coefficient, ScalarType scalar, std::vector<std::string>& lines);

// A double or float literal that reads back as the same number.
std::string cpp_literal(double value, ScalarType scalar);

}  // namespace dashpot::compiler
