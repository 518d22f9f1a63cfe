// A law's programs as assignments of scalars, one after the other: every place of every vector by itself, sums written
// out.
#pragma once

#include <string>
#include <vector>

#include "law/expression_text.hpp"
#include "law/update_law.hpp"

namespace dashpot::testing {

struct ScalarAssignment {
  std::string target;
  bool is_local;
  std::string value;
};

// Names as emitted, states with an underscore behind.
std::string scalar_name(const compiler::Variable& variable, std::size_t place);
std::string scalar_name(const compiler::Coefficient& coefficient, std::size_t place);

// Of a law without coupled slips or tunables.
std::vector<ScalarAssignment> scalar_program(const compiler::UpdateLaw& law,
                                             const std::vector<compiler::Statement>& program);

bool is_table(const compiler::Coefficient& coefficient);  // which `pick` reads by place, in brackets

bool is_straight(const compiler::UpdateLaw& law);  // neither coupled slips nor tunables: the law is all in its programs

}  // namespace dashpot::testing
