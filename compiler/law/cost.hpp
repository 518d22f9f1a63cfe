// What a program of a law costs each time it runs: counts that are the same on every machine.
#pragma once

#include "law/update_law.hpp"

namespace dashpot::compiler {

struct Cost {
  std::size_t additions = 0;  // and subtractions
  std::size_t multiplications = 0;
  std::size_t selections = 0;  // clamps and choices
  std::size_t guards = 0;      // against subnormals
  std::size_t coupled = 0;     // additions, multiplications and divisions for coupled slips, at most
  std::size_t states = 0;
};
Cost cost_of(const UpdateLaw& law, const std::vector<Statement>& program);

std::size_t operations_of(const Cost& cost);  // all of them, whatever they are

}  // namespace dashpot::compiler
