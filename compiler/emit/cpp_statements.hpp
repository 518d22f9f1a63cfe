// Statements of an update law as lines of C++: straight-line with the author's names for few states, rolled loops over
// structure-of-arrays coefficients for many.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "discretise/update_law.hpp"

namespace dashpot::compiler {

class CppStatements {
 public:
  // Both outlive this.
  CppStatements(const UpdateLaw& law, const Network& network);

  std::vector<std::string> lines_of(const std::vector<Statement>& program);

  // What begins an assignment to a place of `target`: its declaration where it is a local.
  std::string assignment(const Variable& target, std::size_t place) const;
  std::string expression(ExpressionId id, std::size_t place);
  static std::string scalar_name(const Variable& variable);

  bool is_rolled() const { return rolled_; }
  bool is_rolled(const Coefficient& coefficient) const { return rolled_ && coefficient.values.size() > 1; }
  std::size_t padded(std::size_t size) const { return (size + law_.lanes - 1) / law_.lanes * law_.lanes; }

  // What the lines so far refer to.
  bool uses(const Coefficient& coefficient) const { return used_coefficients_.count(&coefficient) != 0; }
  bool uses_flush() const { return uses_flush_; }
  bool uses_total() const { return uses_total_; }

 private:
  void print_unrolled(const Statement& statement, std::vector<std::string>& lines);
  void print_loop(const std::vector<Statement>& program, std::size_t first, std::size_t last, std::vector<std::string>& lines);
  void clear_lane(const Variable& vector, std::vector<std::string>& lines) const;
  std::string lane(const Variable& vector) const;
  void find_sums(ExpressionId id);
  void find_vectors(ExpressionId id);
  bool outlives_loop(const Variable& variable) const;
  std::string sum_text(const Variable& vector);
  std::string vector_name(const Variable& variable, std::size_t place) const;
  std::size_t padded_size(const Statement& statement) const { return padded(law_.variables[statement.target].size); }

  const UpdateLaw& law_;
  const Network& network_;
  bool rolled_;
  bool uses_flush_ = false, uses_total_ = false;
  std::set<const Coefficient*> used_coefficients_;
  std::set<VariableId> summed_;  // of the program at hand
  std::set<const Variable*> outliving_;
};

}  // namespace dashpot::compiler
