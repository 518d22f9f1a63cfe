// A velocity that the device measures: passed on as it is. The sensor's own bandwidth is first order,
//     G(s) = ω_b/(s + ω_b)
// and unlimited where it is not stated. No position sample enters; the pulse transfer function published for the
// certificate is the exact one for positions linear between samples, as in theory section 3 (`exact`):
//     E(z) = (1 − a)(1 − z⁻¹)/T / (1 − a z⁻¹),    a = e^{−ω_b T}
// With an unlimited bandwidth that is the one-sample difference, half a sample later than the sensor itself.
#pragma once

#include <dashpot/elementary.hpp>
#include <dashpot/estimators/half_turns.hpp>
#include <dashpot/estimators/pulse_transfer.hpp>

namespace dashpot {

template <class Scalar>
class sensor {
 public:
  // `bandwidth` [Hz], 0: unlimited; `sample_period` T [s] > 0.
  constexpr sensor(double bandwidth, double sample_period) noexcept
      : bandwidth_(bandwidth), sample_period_(sample_period) {}

  void reset(Scalar) noexcept {}

  // Measured velocity → velocity [m/s] or [rad/s].
  Scalar update(Scalar velocity) noexcept { return velocity; }

  constexpr double delay() const noexcept { return bandwidth_ > 0 ? 1 / (2 * pi * bandwidth_) : 0; }  // 1/ω_b [s]
  constexpr double max_gain() const noexcept { return 1; }

  constexpr pulse_transfer<1> transfer() const noexcept {
    const double forgotten = bandwidth_ > 0 ? 1 - decay(2 * pi * bandwidth_ * sample_period_) : 1;
    const double rate = forgotten / sample_period_;
    return {{rate, -rate}, {1, forgotten - 1}, 1, bandwidth_ > 0 ? 1U : 0U};
  }

 private:
  double bandwidth_;      // [Hz]
  double sample_period_;  // T [s]
};

}  // namespace dashpot
