// The paper's update laws written by hand as printed, with the guards. Every coefficient may change from one step to
// the next, as the paper allows, so that each step divides. Without the sample of delay that the paper's indices put
// into the input.
#pragma once

#include "guards.hpp"
#include "maxwell_networks.hpp"
#include "small_networks.hpp"

namespace dashpot::contest {

// A generalised Maxwell network: per branch (17), then (19).
template <class Network>
struct printed_maxwell {
  static constexpr int size = Network::size;
  double stiffness[size], damping[size];                // K [N/m], B [N·s/m]
  double static_stiffness = Network::static_stiffness;  // [N/m]
  double time_step = period;                            // Δt [s]
  double brake = 0;                                     // Σ B [N·s/m]
  double x[size] = {};                                  // hidden states [m]

  printed_maxwell() {
    for (int i = 0; i < size; ++i) {
      stiffness[i] = Network::stiffness(i);
      damping[i] = Network::damping(i);
      brake += damping[i];
    }
  }

  command<double> step(double position, double velocity) noexcept {
    if (!is_finite(position) || !is_finite(velocity)) return {brake, 0};
    double force = static_stiffness * position;
    for (int i = 0; i < size; ++i) {
      const double rate = damping[i] / time_step;
      const double before = x[i];
      x[i] = awake((damping[i] * velocity + rate * before) / (stiffness[i] + rate));
      force -= damping[i] * (x[i] - before) / time_step;
    }
    return {brake, force};
  }
};

// Two Kelvins in series: (11), then the left-hand side of (10) without B1 u̇, which is the brake's.
struct printed_kelvin {
  double stiffness[2] = {two_kelvins::stiffness[0], two_kelvins::stiffness[1]};  // K1, K2 [N/m]
  double damping[2] = {two_kelvins::damping[0], two_kelvins::damping[1]};        // B1, B2 [N·s/m]
  double time_step = period;                                                     // Δt [s]
  double x = 0;                                                                  // hidden state [m]

  command<double> step(double position, double velocity) noexcept {
    if (!is_finite(position) || !is_finite(velocity)) return {damping[0], 0};
    const double before = x;
    const double rate = (damping[0] + damping[1]) / time_step;
    x = awake((stiffness[0] * position + damping[0] * velocity + rate * before) / (stiffness[0] + stiffness[1] + rate));
    return {damping[0], stiffness[0] * (position - x) - damping[0] * (x - before) / time_step};
  }
};

// Fig. 10: (21) but for the sign of the sliding force, which it lacks.
struct printed_needle {
  double stiffness = needle::stiffness;                          // K [N/m]
  double damping[2] = {needle::damping[0], needle::damping[1]};  // B1, B2 [N·s/m]
  double reach = needle::yield_force / needle::stiffness;        // δ_max [m]
  double x = 0;                                                  // hidden state [m]

  command<double> step(double position, double velocity) noexcept {
    if (!is_finite(position) || !is_finite(velocity)) return {damping[0], 0};
    const double deflection = position - x;
    if (!(__builtin_fabs(deflection) > reach)) return {damping[0], stiffness * deflection};
    const double held = __builtin_fabs(deflection) / deflection * reach;
    x = awake(position - held);
    return {damping[0] + damping[1], stiffness * held};
  }
};

}  // namespace dashpot::contest
