// How a linear estimator answers a motion, for host programs: compiler and tests (<complex>, <cmath>).
//
// An estimator's gain is v̂ over the true velocity u̇. Two readings, which agree at low frequency:
//   * velocity_response, G(jω) = E(e^{jωT})/(jω): a sinusoid below Nyquist and nothing else. What fidelity figures and
//     theory section 4 use, frequency by frequency.
//   * max_gain, the largest of |E(e^{jωT})| T/|1 − e^{−jωT}| over 0 … π/T: the estimate held against the one-sample
//     difference. It is the largest ‖v̂‖₂/‖u̇‖₂ over *all* motions, since the difference is the mean of u̇ over the
//     period and so never has more energy than u̇, and as much for motions linear between samples. That is what the
//     tool-damper theorem asks to be at most 1. It is never below max|G(jω)|, as |1 − e^{−jωT}| ≤ ωT.
// The figure of 1.70 at a manoeuvre index of 37 is max_gain, for a Kalman filter whose acceleration is white in
// continuous time; with acceleration constant over each period (kalman.hpp) max_gain is 37/4, the largest |G(jω)| 5.90.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>

#include <dashpot/estimators/half_turns.hpp>
#include <dashpot/estimators/pulse_transfer.hpp>

namespace dashpot {

namespace detail {

// Σ coefficients[i] z⁻ⁱ at z = e^{j angle}.
inline std::complex<double> at_angle(const double* coefficients, unsigned order, double angle) {
  const std::complex<double> backward = std::polar(1.0, -angle);
  std::complex<double> sum = 0;
  for (unsigned i = order + 1; i-- > 0;) sum = sum * backward + coefficients[i];
  return sum;
}

}  // namespace detail

// E(e^{jωT}) [1/s] at the angular frequency ω [rad/s].
template <unsigned MaxOrder>
std::complex<double> position_response(const pulse_transfer<MaxOrder>& transfer, double angular_frequency,
                                       double sample_period) {
  const double angle = angular_frequency * sample_period;
  return detail::at_angle(transfer.numerator, transfer.numerator_order, angle) /
         detail::at_angle(transfer.denominator, transfer.denominator_order, angle);
}

// E(z) T/(1 − z⁻¹) at z = e^{j angle}: the estimate over the one-sample difference, exact at rest too. E has a zero at
// z = 1, and the quotient's coefficients are the partial sums of the numerator's.
template <unsigned MaxOrder>
std::complex<double> difference_response(const pulse_transfer<MaxOrder>& transfer, double angle, double sample_period) {
  double quotient[MaxOrder + 1] = {};
  double sum = 0;
  for (unsigned i = 0; i < transfer.numerator_order; ++i) quotient[i] = sum += transfer.numerator[i];
  return sample_period * detail::at_angle(quotient, transfer.numerator_order, angle) /
         detail::at_angle(transfer.denominator, transfer.denominator_order, angle);
}

// G(jω) = E(e^{jωT})/(jω), and its limit at ω = 0.
template <unsigned MaxOrder>
std::complex<double> velocity_response(const pulse_transfer<MaxOrder>& transfer, double angular_frequency,
                                       double sample_period) {
  // (1 − e^{−jx})/(jx) = e^{−jx/2} sin(x/2)/(x/2)
  const double half = angular_frequency * sample_period / 2;
  const double hold = half == 0 ? 1.0 : std::sin(half) / half;
  return difference_response(transfer, 2 * half, sample_period) * std::polar(hold, -half);
}

namespace detail {

// The peak of `gain` between low and low + width, where it has one, by golden section.
template <class Gain>
double peak_within(Gain gain, double low, double width) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double left = low + (1 - golden) * width;
  double right = low + golden * width;
  double at_left = gain(left), at_right = gain(right);
  // A smooth peak is flat: an angle known to a ten-millionth of its width gives the height to rounding.
  for (; width > 1e-10; width *= golden) {
    if (at_left >= at_right) {
      right = left, at_right = at_left;
      left = low + (1 - golden) * golden * width, at_left = gain(left);
    } else {
      low = left, left = right, at_left = at_right;
      right = low + golden * golden * width, at_right = gain(right);
    }
  }
  return std::max(at_left, at_right);
}

// The largest `gain` over 0 … π: a scan in 4096 steps, and a search around each local peak.
template <class Gain>
double max_over_half_circle(Gain gain) {
  constexpr int steps = 4096;
  const double step = pi / steps;
  double before = gain(0.0), here = gain(step);
  double largest = std::max(before, gain(pi));
  for (int i = 1; i < steps; ++i) {
    const double after = gain((i + 1) * step);
    if (here >= before && here >= after) largest = std::max(largest, peak_within(gain, (i - 1) * step, 2 * step));
    before = here;
    here = after;
  }
  return largest;
}

}  // namespace detail

// The largest ‖v̂‖₂/‖u̇‖₂ over all motions. To 1e-12 relative while no peak is narrower than π/4096 in angle (none of
// the estimators here has one) and the coefficients allow it (pulse_transfer.hpp).
template <unsigned MaxOrder>
double max_gain(const pulse_transfer<MaxOrder>& transfer, double sample_period) {
  return detail::max_over_half_circle(
      [&](double angle) { return std::abs(difference_response(transfer, angle, sample_period)); });
}

// The largest |G(jω)| for 0 ≤ ω ≤ π/T, to the same accuracy.
template <unsigned MaxOrder>
double max_sinusoid_gain(const pulse_transfer<MaxOrder>& transfer, double sample_period) {
  return detail::max_over_half_circle(
      [&](double angle) { return std::abs(velocity_response(transfer, angle / sample_period, sample_period)); });
}

}  // namespace dashpot
