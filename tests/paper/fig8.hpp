// The paper's Fig. 8: contact with a Kelvin element and release, on the rig. A hand presses and withdraws, presses
// again and lets go. The wall of the literature is active while the tool is inside; a contact lets go when the tissue
// would pull.
#pragma once

#include "experiment.hpp"
#include "page.hpp"

namespace dashpot::paper {

struct Fig8 {
  // One way out of the tissue.
  struct Release {
    double impulse = 0;        // of the tissue pulling the tool inwards, brake included [N·s]
    double largest_pull = 0;   // [N]
    double point = 0;          // where the felt force goes through zero [m]
    double motor_impulse = 0;  // of the motor alone pulling [N·s]
    int releases = 0;          // how often the brake is told to let go
  };
  struct Part {
    std::string name;
    Style style;
    Trace trace;
    Release withdrawn;  // by the hand
    Release let_go;
    Maker maker = Maker::emitted;
  };
  // Single and dual with the wall of the literature, single and dual with the contact, and that without the coil’s lag;
  // then wall and contact on the same arm without delay, quantisation and lags.
  std::vector<Part> parts;
  double recovery_difference = 0;  // of single and dual with the wall of the literature, largest after letting go [m]

  const Part& ideal_wall() const { return parts[5]; }
  const Part& ideal_contact() const { return parts[6]; }
};

Fig8 measure_fig8();
Section show(const Fig8& fig8);

}  // namespace dashpot::paper
