// The paper's Fig. 12: the energy that a Maxwell element gives back at a reversal of the velocity, on the rig, led by a
// hand. The ideal is computed offline from the recorded positions, through a filter without delay (paper, 6.4).
#pragma once

#include "energy.hpp"
#include "experiment.hpp"
#include "page.hpp"

namespace dashpot::paper {

struct Fig12 {
  struct Part {
    std::string name;
    Style style;
    Trace trace;
    std::vector<double> velocity;             // offline, without delay [m/s]
    std::vector<double> force, ideal;         // of brake and motor, and of the element under the same motion [N]
    std::size_t reversal = 0;                 // sample
    double returned = 0, ideal_returned = 0;  // [J]
    double felt_returned = 0;           // with the true velocity and the force that acts, brake's residual included [J]
    Readings readings, ideal_readings;  // of (20) after the reversal
    double rms_error = 0;               // of the felt force against the element under the true motion [N]

    double excess() const { return returned / ideal_returned - 1; }
  };
  std::vector<Part> parts;  // single motor, dual channel, what dashpot makes by the paper's rule, and by its default
};

Fig12 measure_fig12();
Section show(const Fig12& fig12);

}  // namespace dashpot::paper
