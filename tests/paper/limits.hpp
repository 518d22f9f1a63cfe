// How much virtual damping a motor can make before limit cycles begin (paper, 2.2 and 6.2): on the rig as rigid as in
// the other figures, and with a structural mode, backlash and amplifier noise.
#pragma once

#include "experiment.hpp"
#include "page.hpp"

namespace dashpot::paper {

struct Limits {
  // What the rig has beside what the other figures give it.
  struct Faults {
    std::string name;
    double mode = 0;      // [Hz]; 0: rigid
    double backlash = 0;  // [mrad]
    double noise = 0;     // [mN·m]
    double inertia = 0;   // of the arm [g·m²]
  };
  // Largest virtual dampings [mN·m·s] by one estimator: that leave the motor's torque smooth, its rms about the mean no
  // more than the arm's own friction; and that do so where the encoder has no steps, the amplifier no noise and the
  // clock no jitter, so that what is left is the loop's own oscillation.
  struct Bound {
    double smooth = 0, stable = 0;
  };
  struct Row {
    Faults faults;
    Bound raw, filtered;           // the difference of one sample; the paper's filter
    std::vector<double> cutoffs;   // of 4th-order filters [Hz]
    std::vector<Bound> by_cutoff;  // as many
  };
  struct Run {
    std::string name;
    Style style;
    Trace trace;
  };
  std::vector<Row> rows;   // rigid; noise, mode, mode and backlash; all at once
  std::vector<Row> modes;  // all at once, over inertia and mode's frequency, without by_cutoff
  std::vector<Run>
      runs;  // with all faults: the printed 7 mN·m·s, raw and filtered; filtered, half as much again as is stable
};

inline constexpr double printed_damping = 7;  // of the brakes, as printed [mN·m·s]

// `thinned`: the mode's frequency at the ends of its range and where it is drawn, cutoffs at their ends and 120 Hz.
Limits measure_limits(bool thinned = false);
Section show(const Limits& limits);

}  // namespace dashpot::paper
