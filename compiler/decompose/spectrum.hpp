// How a split b·u̇ + m differs from the network over frequency, when the motor's velocity is an estimate.
#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "decompose/choices.hpp"
#include "decompose/port_device.hpp"
#include "linear/linear_form.hpp"

namespace dashpot::compiler {

// The part of the motor's impedance that the estimate drives, and the part that position drives, apart from the static
// spring: rendered = b + A (k0/jω + position_driven + velocity_driven·G), with A the loop's delay and the amplifier's
// lag.
struct MotorImpedance {
  std::complex<double> position_driven;  // [N·s/m]
  std::complex<double> velocity_driven;  // [N·s/m]
};
MotorImpedance motor_impedance(const LinearForm& form, double damping, StateInput input, double angular_frequency);

// max |Z_rendered − Z|/|Z| over the device's band, Z with the static spring [1]. The hold's own half period is not in
// it, so that a motor without estimate, delay and lag has none; nor is what is added for passivity.
double largest_error(const LinearForm& form, double damping, StateInput input, const PortDevice& device);

// The largest value of a function of ω over the device's band or, without a device, the default band: a scan refined at
// its maximum.
double largest_in_band(const PortDevice& device, const std::function<double(double)>& function);

// max b ω/|D| over the device's band: how many times the network's force the brake makes, which the motor then takes
// back [1].
double largest_brake_share(const LinearForm& form, double damping, const PortDevice& device);

// The least extra damping [N·s/m] that keeps the split passive for any estimator with |G| ≤ 1 and any delay, the brake
// giving at least (1 − ε) b: max over ω of (|velocity_driven| − Re position_driven − (1 − ε) b), not below zero.
// A scan refined at its maximum, not a bound.
double extra_damping_any_delay(const LinearForm& form, double damping, StateInput input, double tolerance);

}  // namespace dashpot::compiler
