// The emitted law run over a motion, without emission.
#pragma once

#include <functional>
#include <vector>

#include "emit/emission.hpp"

namespace dashpot::compiler {

struct LawRun {
  std::vector<double> time, position, velocity;  // as given to the law
  std::vector<double> brake, motor;              // b·v̂ and m [N] or [N·m]

  double force(std::size_t sample) const { return brake[sample] + motor[sample]; }
};

// From reset(0), samples 0 … count, with exact velocities.
LawRun run_law(const UpdateLaw& law, std::size_t count, const std::function<double(double)>& position,
               const std::function<double(double)>& velocity);

}  // namespace dashpot::compiler
