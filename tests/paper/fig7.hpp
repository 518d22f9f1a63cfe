// The paper's Fig. 7: what can be known of a slow velocity through the rig's encoder at 10 kHz. The arm is moved as by
// a hand, every estimator sees the same positions.
#pragma once

#include <string>
#include <vector>

#include "experiment.hpp"
#include "page.hpp"

namespace dashpot::paper {

struct Fig7 {
  struct Estimate {
    std::string name;
    std::vector<double> velocity;  // at the joint [rad/s]
    double rms_error;              // against the true velocity, sample by sample, from 0.1 s on [rad/s]
    double noise;                  // rms after its own delay is taken out [rad/s]
    double delay;                  // of the least rms error against the delayed truth [s]
    double worst;                  // largest error [rad/s]
  };
  std::vector<double> time, position, velocity;  // true velocity; position as counted [s], [rad], [rad/s]
  double quantum = 0;                            // smallest step of the one-sample difference that occurs [rad/s]
  std::vector<double> averaged;                  // 100 samples, centred: no delay, not causal [rad/s]
  std::vector<Estimate> estimates;               // raw difference first, the paper's filter second
  double crossing_delay = 0;                     // of the paper's filter where the velocity crosses zero, mean [s]
};

Fig7 measure_fig7();
Section show(const Fig7& fig7);

}  // namespace dashpot::paper
