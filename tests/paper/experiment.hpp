// The one form in which every experiment is described: a plant, what is done to it, and the realisations of a network
// that are compared on it. Everything of the tool is in [m], [N], [s]; the plant is a device file or a struct like it.
#pragma once

#include <dashpot/device_description.hpp>
#include <dashpot/simulated/scenario.hpp>

#include <cmath>
#include <string>
#include <vector>

#include "law.hpp"

namespace dashpot::paper {

// A law, and the velocity estimate that it is given.
struct Realisation {
  std::string name;
  LawMaker law;
  velocity_description velocity;
  unsigned lateness = 0;  // further samples by which the estimate is delayed
};

struct Experiment {
  device_description plant;
  simulated::scenario motion;  // the hand, what it intends, what stands in its way
  double duration = 1;         // [s]
  std::vector<Realisation> realisations;
};

// One sample of a run, at the tool. Forces oppose it.
struct Sample {
  double time = 0;                 // [s]
  double position = 0;             // true [m]
  double velocity = 0;             // true [m/s]
  double measured = 0;             // position by the encoder [m]
  double estimate = 0;             // of the velocity [m/s]
  command<double> commanded = {};  // at this sample
  double motor = 0;                // what acts at this instant, of commands before [N]
  double damping = 0;              // likewise [N·s/m]
  double hand = 0;                 // of the hand on the device, along the motion [N]

  double felt() const { return motor + damping * velocity; }
  double commanded_force() const { return commanded.force + commanded.damping * velocity; }
};
using Trace = std::vector<Sample>;

// The law on the simulated device, sample by sample from time 0 to the end.
Trace run(const Experiment& experiment, const Realisation& realisation);

// Every realisation in turn.
std::vector<Trace> run(const Experiment& experiment);

}  // namespace dashpot::paper
