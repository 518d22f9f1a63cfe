// A liquid that is the same in all directions, on an arm of two joints: by brakes on the joints, by brakes on their sum
// and difference, and by motors alone, which follow a late estimate.
#pragma once

#include <string>

#include "arm_run.hpp"
#include "page.hpp"

namespace dashpot::paper {

struct Isotropic {
  struct Small {
    double frequency;  // of the small circle [Hz]
    double share;      // of the power b v² that is taken from the hand [1]
    double expected;   // closed form [1]
  };
  struct Part {
    std::string name;
    Style style;
    ArmTrace circle;           // slow
    double error = 0;          // of the force from b v, rms, over that of b v [1]
    std::vector<Small> small;  // by ascending frequency
    ArmTrace drawn;            // small, at isotropic.drawn
    double lowest_share() const;
  };
  double coupling = 0;      // cosine between the columns of J at the circles' centre
  std::vector<Part> parts;  // motors alone, joint brakes, coupled brakes
};

Isotropic measure_isotropic();
Section show(const Isotropic& isotropic);

}  // namespace dashpot::paper
