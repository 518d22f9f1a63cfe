#include "ramp_and_hold.hpp"

#include <algorithm>
#include <cmath>

namespace dashpot::paper {

double RampAndHold::position(double time) const { return rate * std::min(time, ramp_time); }

double RampAndHold::velocity(double time) const { return time > 0 && time <= ramp_time ? rate : 0; }

// σ = ε̇ η1 (1 − e^{−(μ1/η1) t}) + ε̇ η2 (1 − e^{−(μ2/η2) t}) + μ3 ε̇ t; each exponential fades when the ramp has stopped.
double closed_form_force(const MaxwellSolid& solid, const RampAndHold& motion, double time) {
  const double ramp = std::min(time, motion.ramp_time);
  const double hold = time - ramp;
  double force = solid.spring * motion.rate * ramp;
  for (const auto& [damping, stiffness] : solid.elements) {
    const double relaxation_rate = stiffness / damping;
    force -= motion.rate * damping * std::expm1(-relaxation_rate * ramp) * std::exp(-relaxation_rate * hold);
  }
  return force;
}

}  // namespace dashpot::paper
