// A tool that is pressed into a ball of tissue that relaxes, and slides round it. The emitted law lets the depth relax.
// A Prony series on each component of the force, as finite-element users know it, gives power for ever.
#pragma once

#include "arm_run.hpp"
#include "page.hpp"

namespace dashpot::paper {

struct Ball {
  struct Slide {
    double speed;                         // round the ball [rad/s]
    ArmTrace by_depth, by_components;     // the emitted law, and (by hand) a Prony series on components
    double depth_power, component_power;  // taken from the hand over quarter turns of its second half [W]
    double expected;                      // − F r ω²λ/(ω² + λ²): of components [W]
    double held;  // ½ F r ω²T of the force that stays: what holding it for a period takes [W]
  };
  std::vector<Slide> slides;  // the first is drawn over time
};

Ball measure_ball();
Section show(const Ball& ball);

}  // namespace dashpot::paper
