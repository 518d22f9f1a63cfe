// An expression as infix text, for people and for back ends of the C family.
#pragma once

#include <functional>
#include <string>

#include "discretise/update_law.hpp"

namespace dashpot::compiler {

// How leaves and functions are spelt.
struct Spelling {
  std::function<std::string(const Variable&)> variable;
  std::function<std::string(const Coefficient&)> coefficient;
  std::function<std::string(const std::string& value)> flush;
  std::function<std::string(const std::string& value, const std::string& limit)> clamp;
  std::function<std::string(const Variable& vector)> sum;
  std::function<std::string(const Coefficient& table, const std::string& place)> pick;
  // Of two values, by a condition that is above zero or not; where it is empty, by C's operator.
  std::function<std::string(const std::string& condition, const std::string& yes, const std::string& no)> where = {};
  // drive + decay · flush(force), where that has a name of its own; else it is spelt out.
  std::function<std::string(const std::string& decay, const std::string& force, const std::string& drive)> relax = {};
};

// How tightly an operation holds its operands together: 0 to 3.
int precedence(Operation operation);

// Parentheses stand exactly where leaving them out would change the order of operations.
std::string expression_text(const UpdateLaw& law, ExpressionId expression, const Spelling& spelling);

}  // namespace dashpot::compiler
