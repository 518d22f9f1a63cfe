// The paper's Fig. 6: a Maxwell element, K = 50 N/m, B = 5 N·s/m, 1 ms, under a sine of velocity of 0.5 Hz, by an
// estimate 5 ms late: ideal, single motor, dual channel; with the energy (20).
#pragma once

#include <array>

#include "energy.hpp"
#include "experiment.hpp"
#include "page.hpp"

namespace dashpot::paper {

struct Fig6 {
  struct Candidate {
    Realisation realisation;
    std::string scheme, state_input;
    Trace trace;
    std::vector<double> energy;  // (20), summed, with the true velocity [J]
    Readings readings;           // of (20) after the reversal at 1 s
    double relative_error;       // rms over 0–4 s relative to the ideal's rms [1]
    double returned;             // energy after the reversal at 1 s [J]
    double minimum_damping;      // the least extra damping for which the sampled loop is passive [N·s/m]
  };
  std::vector<double> time, force, velocity, energy;  // ideal [s], [N], [m/s], [J]
  double returned = 0;                                // ideal [J]
  Readings readings;                                  // ideal
  std::vector<Candidate>
      candidates;          // scheme by scheme: single velocity, dual velocity, dual position, single position
  double unreachable = 0;  // for how long after the reversal force and velocity are opposed: no damper makes that [s]
};

// ḟ + (K/B) f = K u̇ from rest, in closed form [N].
double fig6_force(double time);

Experiment fig6_experiment();
Fig6 measure_fig6();
Section show(const Fig6& fig6);

}  // namespace dashpot::paper
