// Velocity as the one-sample difference through a Butterworth low-pass of order 2 or 4, by the bilinear transform,
// prewarped so that the gain at the cutoff is 1/√2 exactly. Each second-order section is
//     H(s) = 1 / (s² + k s + 1),    s = (1/g)(1 − z⁻¹)/(1 + z⁻¹),    g = tan(π f_c T),
//     k = 2 sin(π (2i + 1)/(2 order))
// and runs as two trapezoidal integrators (Zavalishin, The Art of VA Filter Design, 2012, section 4): its gain at rest
// is 1 whatever the rounding of its coefficients, which the direct form cannot promise in single precision.
// Linear, recursive; delay = group delay at 0 plus the T/2 of the difference. The paper (section 6.2) used order 4,
// 120 Hz.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/estimators/half_turns.hpp>
#include <dashpot/estimators/pulse_transfer.hpp>

namespace dashpot {

template <class Scalar>
class low_pass {
 public:
  static constexpr unsigned max_order = 4;

  // `order` 2 or 4 (anything below 4 is 2); `cutoff` f_c [Hz], 0 < f_c < 1/(2T); `sample_period` T [s] > 0.
  constexpr low_pass(unsigned order, double cutoff, double sample_period) noexcept
      : order_(order < 4 ? 2 : 4),
        sample_period_(sample_period),
        warped_cutoff_(tangent_of_half_turns(cutoff * sample_period)),
        rate_(static_cast<Scalar>(1 / sample_period)),
        sections_{section(warped_cutoff_, damping(0)), section(warped_cutoff_, damping(order_ / 2 - 1))} {}

  void reset(Scalar position) noexcept {
    previous_position_ = position;
    for (section& each : sections_) each.reset();
  }

  // Finite position [m] or [rad] → velocity [m/s] or [rad/s].
  Scalar update(Scalar position) noexcept {
    Scalar velocity = (position - previous_position_) * rate_;
    previous_position_ = position;
    for (unsigned i = 0; i < order_ / 2; ++i) velocity = sections_[i].update(velocity);
    return velocity;
  }

  // T/2 + Σ k T/(2g) [s]
  constexpr double delay() const noexcept {
    double half_samples = 1;
    for (unsigned i = 0; i < order_ / 2; ++i) half_samples += damping(i) / warped_cutoff_;
    return half_samples * sample_period_ / 2;
  }

  constexpr double max_gain() const noexcept { return 1; }  // Butterworth: falls from 1 at rest

  // (1 − z⁻¹)/T · Π g² (1 + z⁻¹)² / ((1 + gk + g²) + 2 (g² − 1) z⁻¹ + (1 − gk + g²) z⁻²)
  constexpr pulse_transfer<max_order + 1> transfer() const noexcept {
    pulse_transfer<max_order + 1> result;
    result.numerator[0] = 1 / sample_period_;
    multiply_polynomial(result.numerator, result.numerator_order, {1.0, -1.0});
    for (unsigned i = 0; i < order_ / 2; ++i) {
      const double g2 = warped_cutoff_ * warped_cutoff_;
      const double gk = warped_cutoff_ * damping(i);
      const double leading = 1 + gk + g2;
      const double gain = g2 / leading;
      multiply_polynomial(result.numerator, result.numerator_order, {gain, 2 * gain, gain});
      multiply_polynomial(result.denominator, result.denominator_order,
                          {1.0, 2 * (g2 - 1) / leading, (1 - gk + g2) / leading});
    }
    return result;
  }

 private:
  class section {
   public:
    constexpr section(double g, double k) noexcept
        : half_step_(static_cast<Scalar>(g)),
          solve_(static_cast<Scalar>(1 / (1 + g * (g + k)))),
          damped_(static_cast<Scalar>(g + k)) {}

    void reset() noexcept { band_state_ = low_state_ = 0; }

    // Trapezoidal: band = s·low and low solve high + k·band + low = input together with both integrators.
    Scalar update(Scalar input) noexcept {
      const Scalar high = (input - damped_ * band_state_ - low_state_) * solve_;
      const Scalar band = band_state_ + half_step_ * high;
      const Scalar low = low_state_ + half_step_ * band;
      band_state_ = flush_below(smallest, band + half_step_ * high);
      low_state_ = flush_below(smallest, low + half_step_ * band);
      return low;
    }

   private:
    static constexpr Scalar smallest = Scalar(1e-30);  // [m/s] or [rad/s]; far below any motion, far above subnormals
    Scalar half_step_;                                 // g
    Scalar solve_;                                     // 1/(1 + gk + g²)
    Scalar damped_;                                    // g + k
    Scalar band_state_ = 0;                            // [m/s] or [rad/s]
    Scalar low_state_ = 0;                             // [m/s] or [rad/s]
  };

  // k of section i, the most damped first.
  constexpr double damping(unsigned i) const noexcept {
    return 2 * sine_of_half_turns((order_ - 1 - 2.0 * i) / (2.0 * order_));
  }

  unsigned order_;
  double sample_period_;  // T [s]
  double warped_cutoff_;  // g
  Scalar rate_;           // 1/T [1/s]
  section sections_[2];
  Scalar previous_position_ = 0;
};

}  // namespace dashpot
