// The paper's update law for its Fig. 5 model, written by hand as printed: per Maxwell branch (17), then (19); every
// coefficient may change from one step to the next, so that each step divides.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::benchmarks {

struct printed_law {
  double stiffness[2] = {12, 10};  // K1, K2 [N/m]
  double damping[2] = {5, 6};      // B1, B2 [N·s/m]
  double static_stiffness = 5;     // K3 [N/m]
  double period = 0.001;           // Δt [s]
  double x[2] = {0, 0};            // hidden states [m]

  command<double> step(double position, double velocity) noexcept {
    double force = static_stiffness * position;
    for (int i = 0; i < 2; ++i) {
      const double rate = damping[i] / period;
      const double before = x[i];
      x[i] = (damping[i] * velocity + rate * before) / (stiffness[i] + rate);
      force -= damping[i] * (x[i] - before) / period;
    }
    return {damping[0] + damping[1], force};
  }
};

}  // namespace dashpot::benchmarks
