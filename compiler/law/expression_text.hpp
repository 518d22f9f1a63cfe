// An expression as infix text, for people and for languages of the C family.
#pragma once

#include <functional>
#include <string>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// How names are written; operations are written as operations.def says.
struct Spelling {
  Language language = Language::text;
  std::string suffix = "";  // of functions, if a language has one for each type
  std::string law = "";     // before functions that each law has of its own
  std::function<std::string(VariableId variable)> variable;
  std::function<std::string(CoefficientId coefficient)> coefficient;  // also the table that `pick` reads
  std::function<std::string(VariableId vector)> sum;
};

// Parentheses stand exactly where leaving them out would change the order of operations.
std::string expression_text(const UpdateLaw& law, ExpressionId expression, const Spelling& spelling);

}  // namespace dashpot::compiler
