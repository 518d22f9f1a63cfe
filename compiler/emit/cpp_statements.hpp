// Statements of an update law as lines of C++: straight-line with the author's names for few states, rolled loops over
// structure-of-arrays coefficients for many.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "law/update_law.hpp"
#include "emit/cpp_program.hpp"

namespace dashpot::compiler {

class CppStatements {
 public:
  // Both outlive this.
  CppStatements(const UpdateLaw& law, const Network& network, Timing timing);

  // A variable that is a key of `given` is replaced by the one that it was copied from.
  std::vector<std::string> lines_of(const std::vector<Statement>& program,
                                    const std::map<VariableId, VariableId>& given = {});
  // The same of a program that assigns to states: in constant time only where the mask `sampled` is set.
  std::vector<std::string> kept_lines_of(const std::vector<Statement>& program);
  // Loops of their own, before those of `update`; in constant time they too leave everything as it is unless `sampled`
  // is set.
  std::vector<std::string> lines_of(const std::vector<GuardInTurn>& guards);

  // What begins an assignment to a place of `target`: its declaration where it is a local.
  std::string assignment(const Variable& target, std::size_t place) const;
  std::string expression(ExpressionId id, std::size_t place);  // straight-line
  std::string rolled_expression(ExpressionId id);              // in a loop, of the places from j on
  static std::string scalar_name(const Variable& variable);

 private:
  void print_unrolled(const Statement& statement, std::vector<std::string>& lines);
  void print_loop(const std::vector<Statement>& program, std::size_t first, std::size_t last,
                  std::vector<std::string>& lines);
  int reads_of(ExpressionId id, VariableId vector) const;
  std::string lane(const Variable& vector) const;
  void hoist_scalars(ExpressionId id, std::vector<std::string>& lines);
  bool outlives_loop(const Variable& variable) const;
  bool is_array(const Variable& vector) const;
  std::string sum_text(const Variable& vector);
  std::string vector_name(const Variable& variable, std::size_t place) const;
  std::string place_name(const Variable& variable, std::size_t place) const;
  std::string array_name(const Variable& variable) const;
  const Variable& original(const Variable& variable) const {
    const auto found = given_.find(&variable);
    return found == given_.end() ? variable : *found->second;
  }
  const Variable& target(const Statement& statement) const { return law_.variables[statement.target]; }

  const UpdateLaw& law_;
  const Network& network_;
  bool branch_free_;
  bool masks_states_ = false;                // of the program at hand
  std::set<VariableId> summed_;              // of the program at hand
  std::set<VariableId> assigned_, hoisted_;  // likewise
  const Variable* in_register_ = nullptr;    // of the statement at hand
  std::map<const Variable*, const Variable*> given_;
  std::set<const Variable*> outliving_;
};

}  // namespace dashpot::compiler
