// A linear part between two ends, while parameters change.
#pragma once

#include <string>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// Block 0 joins tool, or surface, and ground.
struct TunedBlock {
  std::string name;
  ExpressionId stiffness = {};    // g, in set(); `nothing` if it has none [N/m]
  ExpressionId feedthrough = {};  // b∞, tuned; `nothing` if it has none [N·s/m]
  VariableId held = {};           // π, a state; `nothing` for dampers alone [N]
};

}  // namespace dashpot::compiler
