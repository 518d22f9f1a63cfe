// How the force felt from a sampled law on a device differs from its network's, over frequency.
//
// The brake makes (1 ± ε)(b + x), where x is added to b for passivity. The motor's law H(z) acts on samples of the
// position, n samples late, is held for the period T and passes the amplifier's lag τ. A motion e^{jωt} of the tool
// then meets, at its own frequency,
//     F = jω (1 ± ε)(b + x) + e^{−jωnT}/(1 + jωτ) · (1 − e^{−jωT})/(jωT) · H(e^{jωT})
//     H = k0 + Σ c_i δ/(1 − a_i w) + E (b∞ − b + Σ e_i w/(1 − a_i w)),    w = e^{−jωT},  δ = 1 − w
// where E is the estimator's response from position to velocity. The error is |F/D − 1|, D the network's closed form.
// The coil does not matter: the brake of a linear network gets a constant command. The device's own inertia, friction
// and damping are felt with every law alike and are not counted.
#pragma once

#include <complex>
#include <vector>

#include "certify/estimator_factors.hpp"
#include "certify/motor_constants.hpp"
#include "decompose/port_device.hpp"
#include "linear/linear_form.hpp"

namespace dashpot::compiler {

class FeltError {
 public:
  // `motor`: the law's constants with b = 0, so that its velocity gain is b∞; `rendered`: the network that the motor
  // and the brake render together; `whole`: what the error is relative to, the same but for networks with slips.
  // Estimators that are not linear count as their delay.
  FeltError(const MotorConstants& motor, const LinearForm& rendered, const LinearForm& whole, const SampledLoop& loop,
            const PortDevice& device);

  // The largest of both signs of ε over the band: a convex function of (b, x) [1].
  double largest(double damping, double added) const;

  // One for each of frequencies(), the larger of both signs of ε [1].
  std::vector<double> over_band(double damping, double added) const;
  const std::vector<double>& frequencies() const { return frequencies_; }  // [Hz], 100 a decade, both ends of the band

 private:
  struct Place {
    std::complex<double> without_brake;  // F/D − 1 at b = x = 0
    std::complex<double> of_motor;       // change of it by b through the motor [1/(N·s/m)]
    std::complex<double> of_brake;       // jω/D: change of it by b and x through an exact brake [1/(N·s/m)]
  };
  Place place(const MotorConstants& motor, std::complex<double> rendered, std::complex<double> reference,
              double angular_frequency) const;
  std::complex<double> estimate(double angular_frequency, std::complex<double> difference) const;

  // One for each frequency.
  struct Parts {
    std::vector<double> real, imaginary;
  };
  static void append(Parts& parts, std::complex<double> value);

  // What `take` makes of the squares of the error at all frequencies [1].
  template <class Take>
  auto of_squares(double damping, double added, Take take) const;

  const PortDevice& device_;
  double sample_period_;                     // [s]
  std::optional<EstimatorFactors> factors_;  // empty where PortDevice's response is used
  double tolerance_;
  std::vector<double> frequencies_;
  Parts without_brake_, of_motor_, of_brake_;  // the same of all places
};

}  // namespace dashpot::compiler
