// Han's tracking differentiator with the discrete time-optimal synthesis fst (Han, IEEE Trans. Industrial Electronics
// 56(3), 2009; for velocity cf. Su et al. 2006):
//     x1 ← x1 + T x2,    x2 ← x2 − T R fst(x1 − y, x2, R, h),    v̂ = x2
//     fst(e, v, R, h): d = R h, s = e + h v, a = v + s/h                           where |s| ≤ d h,
//                                            a = v + ½ (√(d² + 8 R |s|) − d) sgn s  elsewhere;
//                      a/d where |a| ≤ d, sgn a elsewhere
// R bounds the acceleration of v̂; h = n T, n = filter_factor, widens the zone where the law is linear and so smooths
// it. There v̂ is the one-sample difference filtered twice by 1/(n (1 − (1 − 1/n) z⁻¹)): delay T (2n − 3/2). The zone
// ends at the speed R h, beyond which the delay grows with the speed, and an encoder step above R h² leaves it too,
// whatever the speed: such steps are followed at the pace R allows.
// Not linear. Its tuning was not found in an original comparison: treat it as a starting point.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/elementary.hpp>
#include <dashpot/estimators/signs.hpp>

namespace dashpot {

template <class Scalar>
class tracking_differentiator {
 public:
  // `acceleration` R [m/s²] or [rad/s²] > 0; `filter_factor` h/T ≥ 1; `sample_period` T [s] > 0.
  constexpr tracking_differentiator(double acceleration, double filter_factor, double sample_period) noexcept
      : filter_factor_(filter_factor),
        sample_period_(sample_period),
        period_(static_cast<Scalar>(sample_period)),
        horizon_(static_cast<Scalar>(filter_factor * sample_period)),
        acceleration_(static_cast<Scalar>(acceleration)) {}

  void reset(Scalar position) noexcept {
    previous_position_ = position;
    error_ = velocity_ = 0;
  }

  // Finite position [m] or [rad] → velocity [m/s] or [rad/s].
  Scalar update(Scalar position) noexcept {
    const Scalar error = error_ - (position - previous_position_);
    previous_position_ = position;
    error_ = flush_below(smallest, error + period_ * velocity_);
    velocity_ = flush_below(smallest, velocity_ - period_ * acceleration_ * synthesis(error));
    return velocity_;
  }

  constexpr double delay() const noexcept { return sample_period_ * (2 * filter_factor_ - 1.5); }  // linear zone [s]

  // Mean delay near a steady `speed` [m/s] or [rad/s], encoder steps apart [s]. Beyond the linear zone x1 lags y by
  // v²/2R + 3hv/2, and v̂ lags u̇ by the derivative of that.
  constexpr double delay_at(double speed) const noexcept {
    const double bound = static_cast<double>(acceleration_);
    const double v = magnitude(speed);
    if (v <= bound * filter_factor_ * sample_period_) return delay();
    return v / bound + 1.5 * (filter_factor_ - 1) * sample_period_;
  }

 private:
  // fst(e, v, R, h), between −1 and 1.
  Scalar synthesis(Scalar error) const noexcept {
    const Scalar span = acceleration_ * horizon_;             // d
    const Scalar ahead = error + horizon_ * velocity_;        // s
    const Scalar demand = velocity_ + approach(ahead, span);  // a
    return clamp_magnitude(demand / span, Scalar(1));
  }

  // The velocity to be given up on the way to s = 0.
  Scalar approach(Scalar ahead, Scalar span) const noexcept {
    if (magnitude(ahead) <= span * horizon_) return ahead / horizon_;
    const Scalar root = square_root(span * span + 8 * acceleration_ * magnitude(ahead));
    return Scalar(0.5) * (root - span) * sign(ahead);
  }

  static constexpr Scalar smallest = Scalar(1e-30);  // [m], [m/s] …; far below any motion, far above subnormals
  double filter_factor_;                             // n = h/T
  double sample_period_;                             // T [s]
  Scalar period_;                                    // T [s]
  Scalar horizon_;                                   // h [s]
  Scalar acceleration_;                              // R [m/s²] or [rad/s²]
  Scalar previous_position_ = 0;                     // y_{k−1} [m] or [rad]
  Scalar error_ = 0;                                 // x1 − y_{k−1} [m] or [rad]
  Scalar velocity_ = 0;                              // x2 [m/s] or [rad/s]
};

}  // namespace dashpot
