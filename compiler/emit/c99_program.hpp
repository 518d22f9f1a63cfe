// An update law's programs as lines of C99: straight-line with the author's names for few states, loops over arrays for
// many. States are members of `self`; constants stand in the function that reads them.
#pragma once

#include <string>
#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

struct C99Program {
  std::vector<std::string> states;  // members of the struct
  std::vector<std::string> reset;
  std::vector<std::string> output;  // down to the assignment of `command`
  std::vector<std::string> update;  // of a finite sample
  std::vector<std::string> energy;  // down to that of `stored`
};

// Of laws without couplings, networks and tunables.
C99Program c99_program(const UpdateLaw& law);

}  // namespace dashpot::compiler
