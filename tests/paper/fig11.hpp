// The paper's Fig. 11: a needle that sticks and slides (Fig. 10), through several reversals by hand, on the rig: (21)
// by the motor alone and by motor and brake, and what dashpot emits for the network.
#pragma once

#include "experiment.hpp"
#include "page.hpp"

namespace dashpot::paper {

struct Fig11 {
  struct Part {
    std::string name;
    Style style;
    Trace trace;
    std::vector<double> truth;  // of the network under the same motion [N]
    double rms_error = 0;       // of the felt force, after the first half stroke [N]
    double spike = 0;           // largest error within 15 ms after a reversal, mean of the reversals [N]
    double jump = 0;  // of the motor's command within one sample, largest of a stroke, mean of the strokes [N]
    int toggles = 0;  // changes of the brake's command
    Maker maker = Maker::emitted;
    double jump_delay = 0;  // of those jumps after their reversal, mean [s]
  };
  std::vector<double> reversals;  // of the first part [s]
  // (21) by the motor alone, by both, without the brake; what dashpot makes of the network by the paper's rule, and by
  // its default.
  std::vector<Part> parts;
};

Fig11 measure_fig11();
Section show(const Fig11& fig11);

}  // namespace dashpot::paper
