// The least damping that a sampled Maxwell element needs beside its brake (Colgate & Schenkel 1994; theory, 6b):
//     b_phys ≥ T/2 · Re{(1 − e^{−jωT}) H(e^{jωT})}/(1 − cos ωT)     for 0 < ω ≤ π/T
// with the true velocity of n samples ago as its estimate, which is what Fig. 6 is about and no estimator of a device.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>

namespace dashpot::paper {

struct SampledMaxwell {
  double stiffness;      // K [N/m]
  double damping;        // B [N·s/m]
  double brake;          // b [N·s/m]
  double period;         // T [s]
  unsigned lateness;     // of the estimate [samples]
  bool exact;            // the scheme; else backward Euler
  bool velocity_driven;  // the state; else by the position
};

// Motor force over position: F ← a F + c Δu, m = F − b v̂.
inline std::complex<double> motor_response(const SampledMaxwell& loop, double angle) {
  const double step = loop.stiffness / loop.damping * loop.period;
  const double a = loop.exact ? std::exp(-step) : 1 / (1 + step);
  const double c = loop.exact ? loop.stiffness * -std::expm1(-step) / step : loop.stiffness * a;
  const std::complex<double> w = std::polar(1.0, -angle), difference = 1.0 - w;
  const std::complex<double> late = std::polar(1.0, -angle * loop.lateness);
  const std::complex<double> drive = loop.velocity_driven ? late : 1.0;
  return c * difference * drive / (1.0 - a * w) - loop.brake * late * difference / loop.period;
}

inline double needed_damping(const SampledMaxwell& loop, double angle) {
  const std::complex<double> difference = 1.0 - std::polar(1.0, -angle);
  return loop.period / 2 * std::real(difference * motor_response(loop, angle)) / (1 - std::cos(angle));
}

// Over a grid of frequencies fine against every time constant there is: accurate to its fourth digit at least, since
// the grid's step h changes a maximum by h² only.
inline double least_extra_damping(const SampledMaxwell& loop) {
  constexpr int steps = 200000;
  double most = 0;
  for (int i = 1; i <= steps; ++i) most = std::max(most, needed_damping(loop, 3.14159265358979323846 * i / steps));
  return std::max(0.0, most - loop.brake);
}

}  // namespace dashpot::paper
