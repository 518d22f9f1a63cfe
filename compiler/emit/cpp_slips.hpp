// Steps of slips that meet at inner nodes, and the tables that they read, as lines of C++ that call the runtime's
// solvers.
#pragma once

#include <string>
#include <vector>

#include "law/update_law.hpp"
#include "emit/cpp_statements.hpp"

namespace dashpot::compiler {

const char* part_name(slip_part kind);  // the enumerator's

void append_step(const UpdateLaw& law, const Statement& statement, const Coupling& coupling, CppStatements& statements,
                 std::vector<std::string>& lines);
void append_step(const UpdateLaw& law, const Statement& statement, const SlipNetwork& network,
                 CppStatements& statements, std::vector<std::string>& lines);

void append_table(const UpdateLaw& law, const Coupling& coupling, std::vector<std::string>& lines);
void append_tables(const UpdateLaw& law, const SlipNetwork& network, std::vector<std::string>& lines);
// What set() changes in the tables, by what it has worked out.
void append_tuning(const UpdateLaw& law, std::vector<std::string>& lines);

}  // namespace dashpot::compiler
