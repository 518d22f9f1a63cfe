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
    double distance = 0;          // rms of the velocity less the ideal's, from the release on [rad/s]
  };
  // The same with another arm, hand and element, the hand led so that it lets go at the printed velocity.
  struct Variation {
    double inertia;                         // of the arm [g·m²]
    double hand, tissue;                    // stiffnesses [N/m]
    double single, dual;                    // first undershoots [rad/s]
    double single_settling, dual_settling;  // [s]
    double single_release, dual_release;    // velocities when let go [rad/s]

    double ratio() const { return single / dual; }
    double advantage() const { return single_settling - dual_settling; }  // of the dual channel [s]
  };
  double release = 0;  // [s]
  std::vector<Variation> variations;
  std::vector<Part> parts;  // ideal, single motor, dual channel, what dashpot makes by the paper's rule, and by default
};

// `thinned`: the sweep at the ends of its ranges only.
Fig13 measure_fig13(bool thinned = false);
Section show(const Fig13& fig13);

}  // namespace dashpot::paper
