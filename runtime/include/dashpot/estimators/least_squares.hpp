// Velocity as the slope of the least-squares line through the last N + 1 positions:
//     v̂_k = 6 (N Σ y_{k−i} − 2 Σ i y_{k−i}) / (T N (N+1)(N+2)),    i = 0 … N
// Linear, finite memory N, delay NT/2. Summed anew every sample: running sums would drift.
#pragma once

#include <dashpot/estimators/position_window.hpp>
#include <dashpot/estimators/pulse_transfer.hpp>

namespace dashpot {

// N Σ y_{k−i} − 2 Σ i y_{k−i} = Σ (N − 2i)(y_{k−i} − y_{k−N+i}) over i < N/2: the pairs make it exactly 0 at rest,
// wherever that is, and keep single precision usable far from zero.
template <class Scalar, unsigned MaxWindow>
Scalar slope_sum(const position_window<Scalar, MaxWindow>& positions, unsigned window) noexcept {
  Scalar sum = 0;
  for (unsigned i = 0; 2 * i < window; ++i)
    sum += static_cast<Scalar>(window - 2 * i) * (positions[i] - positions[window - i]);
  return sum;
}

template <class Scalar, unsigned MaxWindow = 64>
class least_squares {
 public:
  // `window` N in samples, brought to the nearest of 1 … MaxWindow; `sample_period` T [s] > 0.
  constexpr least_squares(unsigned window, double sample_period) noexcept
      : window_(positions::nearest(window)), sample_period_(sample_period), rate_(static_cast<Scalar>(rate())) {}

  void reset(Scalar position) noexcept { positions_.fill(position); }

  // Finite position [m] or [rad] → velocity [m/s] or [rad/s].
  Scalar update(Scalar position) noexcept {
    positions_.push(position);
    return slope_sum(positions_, window_) * rate_;
  }

  constexpr unsigned window() const noexcept { return window_; }
  constexpr double delay() const noexcept { return window_ * sample_period_ / 2; }  // [s]
  constexpr double max_gain() const noexcept { return 1; }  // a positive average of one-sample differences

  constexpr pulse_transfer<MaxWindow> transfer() const noexcept {
    pulse_transfer<MaxWindow> result;
    for (unsigned i = 0; i <= window_; ++i) result.numerator[i] = rate() * (static_cast<double>(window_) - 2.0 * i);
    result.numerator_order = window_;
    return result;
  }

 private:
  // 6/(T N (N+1)(N+2)) [1/s]
  constexpr double rate() const noexcept {
    const double n = window_;
    return 6 / (sample_period_ * n * (n + 1) * (n + 2));
  }

  using positions = position_window<Scalar, MaxWindow>;
  unsigned window_;       // N [samples]
  double sample_period_;  // T [s]
  Scalar rate_;           // [1/s]
  positions positions_;
};

}  // namespace dashpot
