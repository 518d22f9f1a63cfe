// First-order adaptive window (Janabi-Sharifi, Hayward & Chen, IEEE Trans. Control Systems Technology 8(6), 2000): the
// window grows, n = 1, 2, …, while its samples lie within ±d of one line, so that it is long when the motion is steady
// and short when it is not. Growth ends at the first n that fails or at the longest window.
//
// End fit: the line joins the newest and the oldest sample, d is one count, v̂ = (y_k − y_{k−n})/(nT). O(n) exactly:
// all inner samples lie within d of it when its slope lies in every [(y_k−y_{k−j}−d)/(jT), (y_k−y_{k−j}+d)/(jT)] of
// the inner j.
//
// Best fit: d is half a count, v̂ is the least-squares slope of the window. Published implementations disagree about
// the intercept of the line the samples are held against: some draw it through the newest sample, some through the
// mean. Built here is neither: the window is accepted while *any* line stays within ±d of it, which is the case when
// one slope lies in [(y_i−y_j−2d)/((j−i)T), (y_i−y_j+2d)/((j−i)T)] of every pair. A steady motion then never shortens
// the window, whether the encoder floors or rounds; with the other two intercepts it does, and costs a factor of 13 and
// of 3 in rms error (30 µm, 1 kHz, 0.5 Hz at 10 mm/s peak, n_max = 16). O(n²/2).
//
// Not linear; finite memory; delay at most n_max T/2, which it is in slow motion.
#pragma once

#include <dashpot/estimators/least_squares.hpp>
#include <dashpot/estimators/position_window.hpp>

namespace dashpot {

enum class foaw_fit : unsigned char { end, best };

namespace detail {

// The slopes, per sample, that a set of bounds leaves. Kept as fractions and compared by cross-multiplication, so that
// no division is rounded.
template <class Scalar>
class slope_interval {
 public:
  // Slopes s with |difference − s·span| ≤ band.
  void narrow(Scalar difference, Scalar span, Scalar band) noexcept {
    const Scalar low = difference - band;
    const Scalar high = difference + band;
    if (!bounded_ || low * low_.span > low_.difference * span) low_ = {low, span};
    if (!bounded_ || high * high_.span < high_.difference * span) high_ = {high, span};
    bounded_ = true;
  }

  bool contains(Scalar difference, Scalar span) const noexcept {
    return !bounded_ ||
           (low_.difference * span <= difference * low_.span && difference * high_.span <= high_.difference * span);
  }

  bool is_empty() const noexcept { return bounded_ && low_.difference * high_.span > high_.difference * low_.span; }

 private:
  struct fraction {
    Scalar difference;  // [m] or [rad]
    Scalar span;        // [samples], positive
  };
  bool bounded_ = false;
  fraction low_ = {0, 1};
  fraction high_ = {0, 1};
};

}  // namespace detail

template <class Scalar, unsigned MaxWindow = 64>
class foaw {
 public:
  static_assert(MaxWindow <= 256, "longer windows would need a narrower slack, see `slack`");

  // `longest_window` n_max in samples, brought to the nearest of 1 … MaxWindow; `step` of the encoder [m] or [rad] > 0;
  // `sample_period` T [s] > 0.
  constexpr foaw(unsigned longest_window, foaw_fit fit, double step, double sample_period) noexcept
      : longest_window_(positions::nearest(longest_window)),
        fit_(fit),
        sample_period_(sample_period),
        period_(static_cast<Scalar>(sample_period)),
        band_(static_cast<Scalar>(step * (1 + slack))) {}

  void reset(Scalar position) noexcept { positions_.fill(position); }

  // Finite position [m] or [rad] → velocity [m/s] or [rad/s].
  Scalar update(Scalar position) noexcept {
    positions_.push(position);
    window_ = fit_ == foaw_fit::end ? end_fit_window() : best_fit_window();
    return fit_ == foaw_fit::end ? end_slope() : best_slope();
  }

  unsigned window() const noexcept { return window_; }  // n of the newest estimate [samples]
  constexpr unsigned longest_window() const noexcept { return longest_window_; }
  constexpr double delay() const noexcept { return longest_window_ * sample_period_ / 2; }  // at most [s]

 private:
  // Samples are whole counts, and a sample exactly d off its line is common; whether it counts as within must not hang
  // on rounding. The bounds on either side of a decision are multiples of 1/(n m) counts for spans n, m ≤ 256, so a
  // band wider by a thousandth of a count admits every tie and nothing else.
  static constexpr double slack = 1.0 / 1024;

  using positions = position_window<Scalar, MaxWindow>;
  using interval = detail::slope_interval<Scalar>;

  unsigned end_fit_window() const noexcept {
    interval slopes;
    for (unsigned n = 1; n <= longest_window_; ++n) {
      const Scalar difference = positions_[0] - positions_[n];
      const Scalar span = static_cast<Scalar>(n);
      if (!slopes.contains(difference, span)) return n - 1;
      slopes.narrow(difference, span, band_);
    }
    return longest_window_;
  }

  // The pair bound 2d is one count, the same band as the end fit's.
  unsigned best_fit_window() const noexcept {
    interval slopes;
    for (unsigned n = 1; n <= longest_window_; ++n) {
      for (unsigned i = 0; i < n; ++i) slopes.narrow(positions_[i] - positions_[n], static_cast<Scalar>(n - i), band_);
      if (slopes.is_empty()) return n - 1;
    }
    return longest_window_;
  }

  Scalar end_slope() const noexcept {
    return (positions_[0] - positions_[window_]) / (static_cast<Scalar>(window_) * period_);
  }

  Scalar best_slope() const noexcept {
    const Scalar n = static_cast<Scalar>(window_);
    return Scalar(6) * slope_sum(positions_, window_) / (n * (n + 1) * (n + 2) * period_);
  }

  unsigned longest_window_;  // n_max [samples]
  unsigned window_ = 1;      // n [samples]
  foaw_fit fit_;
  double sample_period_;  // T [s]
  Scalar period_;         // T [s]
  Scalar band_;           // one count, and the slack [m] or [rad]
  positions positions_;
};

}  // namespace dashpot
