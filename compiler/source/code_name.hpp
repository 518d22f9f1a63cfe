// The name by which people look a diagnostic up.
#pragma once

#include <algorithm>
#include <string>

#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// "negative-damping" for DiagnosticCode::negative_damping.
inline std::string code_name(DiagnosticCode code) {
  std::string name(message_template(code).name);
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

}  // namespace dashpot::compiler
