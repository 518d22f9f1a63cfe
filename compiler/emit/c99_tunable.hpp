// What a law with tunable parameters has in C99 beyond its programs: its tables, and the parts of templates/c99/ that
// read them.
#pragma once

#include <string>
#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// As in C99Program. The functions are called {name}_tunable_{name_of(TunableCall)}.
struct C99Tunables {
  std::vector<std::string> before, states, functions, begin;
};

// Nothing of a law without tunables.
C99Tunables c99_tunables(const UpdateLaw& law, const std::string& name);

}  // namespace dashpot::compiler
