// Steps of slips that meet at inner nodes, and the tables that they read, as lines of C++ that call the runtime's
// solvers.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// How the code around a solver calls the numbers that go in and come out.
struct SolverWords {
  std::function<std::string(VariableId)> read;
  std::function<std::string(VariableId, const std::string& value)> assignment;  // a statement
  std::string given;                                                            // the value of the solver's statement
  bool makes_tables = false;  // what parameters change is written into a table at each step, and not kept in one
};

// Of a statement that solves for slips.
void append_step(const UpdateLaw& law, const Statement& statement, const SolverWords& words,
                 std::vector<std::string>& lines);

// The tables that solvers read: those that no parameter changes, for the class, and all others, for the object.
void append_constant_tables(const UpdateLaw& law, std::vector<std::string>& lines);
void append_kept_tables(const UpdateLaw& law, std::vector<std::string>& lines);
// What set() changes in the tables, by what it has worked out.
void append_tuning(const UpdateLaw& law, std::vector<std::string>& lines);

}  // namespace dashpot::compiler
