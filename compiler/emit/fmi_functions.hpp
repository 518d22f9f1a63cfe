// The functions of the FMI standard that a unit for co-simulation exports without having a use for them.
#pragma once

#include <string_view>
#include <vector>

#include "emit/code_model.hpp"
#include "emit/fmi_unit.hpp"

namespace dashpot::compiler {

// As templates take them: function, parameters, and a statement that reads them all.
struct FmiFunctions {
  std::vector<Fields> without;      // of variables of a type that no variable has: an error unless none is asked for
  std::vector<Fields> refused;      // an error always
  std::vector<Fields> no_instance;  // that make an instance of another kind of unit
};

FmiFunctions unused_functions(FmiVersion version);

}  // namespace dashpot::compiler
