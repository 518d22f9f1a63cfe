// What every split b costs on the rig, for the networks of Figs. 5 and 6: the motor's noise, the error of what is felt,
// and the damping that is still needed, for three estimators and three errors of the brake.
#pragma once

#include <array>

#include "compared_estimators.hpp"
#include "page.hpp"

namespace dashpot::paper {

inline constexpr std::array<double, 3> brake_errors{0, 0.02, 0.05};  // ε

struct Split {
  double brake = 0;                 // b [N·s/m]
  double noise = 0;                 // rms of the motor's force from the encoder's steps [N]
  double error = 0;                 // largest |Z_felt − Z|/|Z| from 0.1 to 30 Hz [1]
  std::array<double, 3> missing{};  // damping needed beyond (1 − ε) b and the arm's own, per error of the brake [N·s/m]
};

struct Pareto {
  struct Sweep {
    std::string network;  // "Fig. 5"
    NamedEstimator estimator;
    std::string state_input;
    double viscosity;           // Z_d(0) [N·s/m]
    std::vector<Split> splits;  // by ascending b

    const Split& best(std::size_t brake_error) const;  // that needs least; of equals, the one of least error
  };
  std::vector<Sweep> sweeps;  // network by network, way to drive the states by way, estimator by estimator
};

Pareto measure_pareto();
const Pareto& measured_pareto();  // once a process
Section show(const Pareto& pareto);

}  // namespace dashpot::paper
