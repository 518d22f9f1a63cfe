// The tables that the solvers of slips read; C++ and C differ only in notation.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

struct TableWords {
  std::string storage;                                                // before the type, with a space behind
  std::string scalar, node, link;                                     // types
  std::string part;                                                   // before the name of a kind of part
  std::function<std::string(const std::string& table)> name;          // of what the law calls so
  std::function<std::string(double value, VariableId tuned)> number;  // `tuned`: where parameters decide, by which
};

// Whether parameters decide what stands in the tables.
bool is_tuned(const Coupling& coupling);
bool is_tuned(const SlipNetwork& network);

// What stands in the solver's list of held forces; `zero` where none is held.
std::string held_forces(const SolvedSlips& slips, const std::string& zero,
                        const std::function<std::string(VariableId)>& read);

// What a step has found, as it is read from the solver's lists, of which `moved` is the name of one.
void each_result_text(const SolvedSlips& slips, const char* moved,
                      const std::function<std::string(const std::string& sign)>& as_scalar,
                      const std::function<void(VariableId target, const std::string& value)>& visit);

void append_tables(const Coupling& coupling, const TableWords& words, std::vector<std::string>& lines);
void append_tables(const SlipNetwork& network, const TableWords& words, std::vector<std::string>& lines);

}  // namespace dashpot::compiler
