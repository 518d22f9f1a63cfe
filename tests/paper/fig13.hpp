// The paper's Fig. 13: a Maxwell element is dragged at 1.8 rad/s and let go, on the rig.
#pragma once

#include "experiment.hpp"
#include "page.hpp"

namespace dashpot::paper {

struct Fig13 {
  struct Part {
    std::string name;
    Style style;
    Trace trace;
    double release_velocity = 0;  // at the joint [rad/s]
    double undershoot = 0;        // the first, and deepest, velocity after the release [rad/s]
    double overshoot = 0;         // the highest after that [rad/s]
    double settling = 0;          // from the release until the speed stays below 5 % of that [s]
  };
  // The same with another spring.
  struct Variation {
    double stiffness;     // [N/m]
    double single, dual;  // first undershoots [rad/s]
  };
  double release = 0;  // [s]
  std::vector<Variation> variations;
  std::vector<Part> parts;  // ideal, single motor, dual channel, dashpot's own choice for the device
};

Fig13 measure_fig13();
Section show(const Fig13& fig13);

}  // namespace dashpot::paper
