// A liquid that turns the tool aside, on a loop that is late: the emitted law's gate lets pass what the brakes pay for,
// over the workspace of an arm. Without it, by hand, more comes out than the brakes take.
#pragma once

#include "arm_run.hpp"
#include "page.hpp"

namespace dashpot::paper {

struct Curl {
  struct Place {
    double angle;                       // between the links [deg]
    ArmTrace gated, ungated;            // joints in circles, the way round that gains
    double gated_power, ungated_power;  // taken from the hand, of the damping's own p q̇² [1]
    double expected;                    // of the latter [1]
    double passed;                      // of the curl by the gate [1]
    double wanted;                      // of the curl, of the joints' damping: |σ|/p [1]
  };
  std::vector<Place> places;  // by ascending angle
  double limit = 0;  // of |σ|/p that the gate lets pass: (1 − ε) less what it keeps for limits that grow [1]

  const Place& at(double angle) const;
};

Curl measure_curl();
Section show(const Curl& curl);

}  // namespace dashpot::paper
