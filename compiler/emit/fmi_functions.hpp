// The functions of the FMI standard that a co-simulation unit must export although it has no use for them.
#pragma once

#include <string_view>
#include <vector>

#include "emit/code_model.hpp"
#include "emit/fmi_unit.hpp"

namespace dashpot::compiler {

// As templates take them: function, parameters, and a statement that reads them all.
struct FmiFunctions {
  std::vector<Fields> without;      // for types that no variable has: an error unless no variable is asked for
  std::vector<Fields> refused;      // always an error
  std::vector<Fields> no_instance;  // make an instance of another kind of unit
};

FmiFunctions unused_functions(FmiVersion version);

}  // namespace dashpot::compiler
