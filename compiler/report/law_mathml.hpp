// Expressions of an update law as MathML.
#pragma once

#include <string>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// Scalar coefficients appear as their numbers, those with one value a mode as letters with the index i. Guards against
// subnormal numbers are not shown.
std::string expression_mathml(const UpdateLaw& law, ExpressionId expression);

// The letters that theory uses for what the law has a name for, else the name itself.
std::string variable_mathml(const Variable& variable);
std::string coefficient_mathml(const Coefficient& coefficient);

}  // namespace dashpot::compiler
