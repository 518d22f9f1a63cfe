// The paper's Fig. 9: a 2nd-order Maxwell solid, compressed by a hand until a rigid obstacle stops it, on the rig.
#pragma once

#include "experiment.hpp"
#include "page.hpp"

namespace dashpot::paper {

struct Fig9 {
  struct Part {
    std::string name;
    Style style;
    Trace trace;
    double before_stop = 0,
           after_stop = 0;       // motor's command just before the obstacle, and when estimates have settled [N]
    double speed = 0;            // just before the obstacle [m/s]
    double felt_error = 0;       // largest |felt − ideal|, from contact until the stop has settled [N]
    double felt_error_time = 0;  // for how long it is more than a fifth of the ideal's peak [s]
    Maker maker = Maker::emitted;
  };
  double touch = 0, stop = 0;  // when the tool meets the object, and the obstacle [s]
  std::vector<Part> parts;     // ideal, single motor, dual channel
  double relaxation_difference =
      0;  // largest |single − dual| of the motor's command after the stop has settled, over the peak [1]
  double relaxation_error = 0;  // largest |dual − ideal| there, over the peak [1]
  double peak = 0;              // of the ideal's force [N]
};

Fig9 measure_fig9();
Section show(const Fig9& fig9);

}  // namespace dashpot::paper
