// Velocity as the difference of the last two positions over the time that really passed between them:
//     v̂_k = (y_k − y_{k−1}) / (t_k − t_{k−1})
// t is the device clock at the sample, which whoever reads the position reads with it: jitter of the loop is then no
// error of the estimate. At a constant period T the one-sample backward difference: memory 1, delay T/2, one encoder
// count is worth Δ/T. Linear in the positions, but with coefficients that change with the clock.
#pragma once

#include <cstdint>

#include <dashpot/estimators/pulse_transfer.hpp>

namespace dashpot {

template <class Scalar>
class interval_difference {
 public:
  // `sample_period` T [s] > 0: between a reset and the first sample, and in delay() and transfer().
  constexpr explicit interval_difference(double sample_period) noexcept
      : sample_period_(sample_period), period_(static_cast<Scalar>(sample_period)) {}

  // At rest there, a sample period before the next sample.
  void reset(Scalar position) noexcept {
    position_ = position;
    started_ = false;
  }

  // Finite position [m] or [rad], device clock at the sample [ns] → velocity [m/s] or [rad/s]. If no time has passed
  // since the previous sample the estimate is 0, and the next estimate covers the way from that sample; a clock that
  // runs backwards is taken to have started anew.
  Scalar update(Scalar position, std::uint64_t timestamp_ns) noexcept {
    const std::int64_t passed_ns = static_cast<std::int64_t>(timestamp_ns - timestamp_ns_);  // across a wrap as well
    if (started_ && passed_ns == 0) return 0;
    const Scalar moved = position - position_;
    const bool is_first = !started_, is_anew = started_ && passed_ns < 0;
    position_ = position;
    timestamp_ns_ = timestamp_ns;
    started_ = true;
    if (is_anew) return 0;
    return moved / (is_first ? period_ : static_cast<Scalar>(passed_ns) * static_cast<Scalar>(1e-9));
  }

  constexpr double delay() const noexcept { return sample_period_ / 2; }  // [s]
  constexpr double max_gain() const noexcept { return 1; }                // at a constant period

  // At a constant period.
  constexpr pulse_transfer<1> transfer() const noexcept {
    pulse_transfer<1> result;
    result.numerator[0] = 1 / sample_period_;
    result.numerator[1] = -result.numerator[0];
    result.numerator_order = 1;
    return result;
  }

 private:
  double sample_period_;            // T [s]
  Scalar period_;                   // T [s]
  std::uint64_t timestamp_ns_ = 0;  // t_{k−1} on the device clock [ns]
  Scalar position_ = 0;             // y_{k−1} [m] or [rad]
  bool started_ = false;            // whether there is a t_{k−1}
};

}  // namespace dashpot
