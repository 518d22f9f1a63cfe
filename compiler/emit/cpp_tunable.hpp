// What a law with tunable parameters has in C++ beyond its programs: its tables, and calls of dashpot::tunable_law.
#pragma once

#include <string>
#include <vector>

#include "emit/cpp_statements.hpp"
#include "law/update_law.hpp"

namespace dashpot::compiler {

// As the tables call it, in C++ and in C.
const char* name_of(tunable_kind kind);

// False where its programs are statements alone.
bool calls_runtime(const UpdateLaw& law);

// The struct `parameters`, and set() with its contract and the lines of its program; of a law without tunables too.
std::vector<std::string> parameters_of(const UpdateLaw& law);
std::vector<std::string> set_of(const UpdateLaw& law, const std::vector<std::string>& tune);

// The beginning of set(): `wanted` becomes the parameters, and `clamped` says of which it could not.
std::vector<std::string> taken_values(const UpdateLaw& law);

// Nothing of a law without tunables.
void append_tables_of_tunables(const UpdateLaw& law, std::vector<std::string>& lines);
// Of one with tunables.
void append_state_of_tunables(const UpdateLaw& law, std::vector<std::string>& lines);

void append_call(const UpdateLaw& law, const Statement& statement, const CallTunable& call, CppStatements& statements,
                 std::vector<std::string>& lines);
// Declares what a call of `tune` or `rest` assigns, as a new object has it.
void append_initial_values(const UpdateLaw& law, const Statement& statement, const CallTunable& call,
                           CppStatements& statements, std::vector<std::string>& lines);

}  // namespace dashpot::compiler
