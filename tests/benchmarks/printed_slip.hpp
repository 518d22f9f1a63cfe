// The paper's update law (21) for its Fig. 10 model, written by hand as printed but for the sign of the sliding force, which
// it lacks.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::benchmarks {

struct printed_slip {
  double stiffness = 1000;        // K [N/m]
  double damping[2] = {2.5, 0.8};  // B1, B2 [N·s/m]
  double reach = 0.0005;          // δ_max [m]
  double x = 0;                   // hidden state [m]

  command<double> step(double position, double) noexcept {
    const double deflection = position - x;
    if (!(deflection > reach || deflection < -reach)) return {damping[0], stiffness * deflection};
    const double held = deflection > 0 ? reach : -reach;
    x = position - held;
    return {damping[0] + damping[1], stiffness * held};
  }
};

}  // namespace dashpot::benchmarks
