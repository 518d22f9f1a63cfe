// Velocity as the difference of two positions N samples apart:
//     v̂_k = (y_k − y_{k−N}) / (N T)
// Linear, finite memory N, delay NT/2, one encoder count is worth Δ/(NT).
#pragma once

#include <dashpot/estimators/position_window.hpp>
#include <dashpot/estimators/pulse_transfer.hpp>

namespace dashpot {

template <class Scalar, unsigned MaxWindow = 64>
class backward_difference {
 public:
  // `window` N in samples, brought to the nearest of 1 … MaxWindow; `sample_period` T [s] > 0.
  constexpr backward_difference(unsigned window, double sample_period) noexcept
      : window_(positions::nearest(window)),
        sample_period_(sample_period),
        rate_(static_cast<Scalar>(1 / (window_ * sample_period))) {}

  void reset(Scalar position) noexcept { positions_.fill(position); }

  // Finite position [m] or [rad] → velocity [m/s] or [rad/s].
  Scalar update(Scalar position) noexcept {
    positions_.push(position);
    return (position - positions_[window_]) * rate_;
  }

  constexpr unsigned window() const noexcept { return window_; }
  constexpr double delay() const noexcept { return window_ * sample_period_ / 2; }  // [s]
  constexpr double max_gain() const noexcept { return 1; }  // an average of one-sample differences

  constexpr pulse_transfer<MaxWindow> transfer() const noexcept {
    pulse_transfer<MaxWindow> result;
    result.numerator[0] = 1 / (window_ * sample_period_);
    result.numerator[window_] = -result.numerator[0];
    result.numerator_order = window_;
    return result;
  }

 private:
  using positions = position_window<Scalar, MaxWindow>;
  unsigned window_;       // N [samples]
  double sample_period_;  // T [s]
  Scalar rate_;           // 1/(NT) [1/s]
  positions positions_;
};

}  // namespace dashpot
