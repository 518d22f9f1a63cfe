// Levant's super-twisting differentiator (Levant, Automatica 34(3), 1998):
//     ẋ = u1 − λ |e|^½ sgn e,  u̇1 = −α sgn e,  e = x − y,  α = 1.1 C,  λ = 1.5 √C,  v̂ = ẋ
// where C bounds the acceleration. Stepped by implicit Euler (cf. Acary & Brogliato, Systems & Control Letters 59,
// 2010): e solves
//     e + T λ |e|^½ sgn e + T² α sgn e = c,    c = e_{k−1} + T u1 − (y_k − y_{k−1})
// with sgn 0 any value of [−1, 1], in closed form. The explicit step would chatter at rest with amplitude αT for ever;
// this one comes to rest exactly. While it slides, e = 0 and v̂ is the one-sample difference: delay T/2 as long as the
// acceleration, encoder steps included, stays below α.
// Not linear.
#pragma once

#include <dashpot/elementary.hpp>
#include <dashpot/estimators/signs.hpp>

namespace dashpot {

template <class Scalar>
class super_twisting {
 public:
  // `acceleration` C [m/s²] or [rad/s²] > 0; `sample_period` T [s] > 0.
  constexpr super_twisting(double acceleration, double sample_period) noexcept
      : sample_period_(sample_period),
        period_(static_cast<Scalar>(sample_period)),
        rate_(static_cast<Scalar>(1 / sample_period)),
        switching_(static_cast<Scalar>(1.1 * acceleration)),
        root_gain_(static_cast<Scalar>(1.5 * square_root(acceleration))) {}

  void reset(Scalar position) noexcept {
    previous_position_ = position;
    error_ = drift_ = 0;
  }

  // Finite position [m] or [rad] → velocity [m/s] or [rad/s].
  Scalar update(Scalar position) noexcept {
    const Scalar lead = error_ - (position - previous_position_);  // e before the step, if x stood still
    previous_position_ = position;
    const Scalar target = lead + period_ * drift_;  // c
    const Scalar reach = period_ * period_ * switching_;
    const Scalar excess = magnitude(target) - reach;
    return excess > Scalar(0) ? approach(excess, sign(target)) : slide(lead);
  }

  constexpr double delay() const noexcept { return sample_period_ / 2; }  // while sliding [s]

 private:
  // c is within reach: e = 0, and u1 takes what that needs.
  Scalar slide(Scalar lead) noexcept {
    error_ = 0;
    drift_ = -lead * rate_;
    return drift_;
  }

  // w = |e|^½ solves w² + T λ w = |c| − T² α.
  Scalar approach(Scalar excess, Scalar side) noexcept {
    const Scalar pull = period_ * root_gain_;
    const Scalar root = 2 * excess / (pull + square_root(pull * pull + 4 * excess));
    error_ = side * root * root;
    drift_ -= side * period_ * switching_;
    return drift_ - side * root_gain_ * root;
  }

  double sample_period_;          // T [s]
  Scalar period_;                 // T [s]
  Scalar rate_;                   // 1/T [1/s]
  Scalar switching_;              // α [m/s²] or [rad/s²]
  Scalar root_gain_;              // λ [√m/s] or [√rad/s]
  Scalar previous_position_ = 0;  // y_{k−1} [m] or [rad]
  Scalar error_ = 0;              // e [m] or [rad]
  Scalar drift_ = 0;              // u1 [m/s] or [rad/s]
};

}  // namespace dashpot
