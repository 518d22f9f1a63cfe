// The motion of the paper's Fig. 5 and the force that a solid of springs and dampers opposes to it, in closed form.
#pragma once

#include <vector>

namespace dashpot::paper {

// At rest at 0, then at constant velocity, then held.
struct RampAndHold {
  double rate;       // [m/s]
  double ramp_time;  // [s]

  double position(double time) const;  // [m]
  double velocity(double time) const;  // [m/s]; at the two knots that of the time before
};

struct MaxwellElement {
  double damping;    // [N·s/m]
  double stiffness;  // [N/m]
};

// Maxwell elements and a spring in parallel: Fig. 2e, with any number of elements.
struct MaxwellSolid {
  std::vector<MaxwellElement> elements;
  double spring;  // [N/m]
};

// Gosline & Hayward 2009, (6), for time ≤ ramp_time, and what follows from it when the ramp stops [N].
double closed_form_force(const MaxwellSolid& solid, const RampAndHold& motion, double time);

}  // namespace dashpot::paper
