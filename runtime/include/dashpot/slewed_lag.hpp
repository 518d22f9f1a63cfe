// A first-order lag whose rate is limited, dx/dt = clamp((demanded − x)/lag, ±slew), solved exactly: straight while the
// rate is limited, exponential afterwards. What an amplifier does with a motor's force. No heap, no <cmath>.
#pragma once

#include <dashpot/exponential.hpp>

namespace dashpot {

// x when `duration` [s] has passed under a constant demand; `lag` [s] may be 0, `slew` [1/s of x's unit] is not.
template <class Scalar>
constexpr Scalar slewed_lag(Scalar x, Scalar demanded, Scalar lag, Scalar slew, Scalar duration) noexcept {
  const Scalar sign = demanded < x ? Scalar(-1) : Scalar(1);
  const Scalar gap = sign * (demanded - x), last_gap = slew * lag;
  const Scalar straight_time = gap > last_gap ? (gap - last_gap) / slew : Scalar(0);
  if (duration < straight_time) return x + sign * slew * duration;
  const Scalar left = gap > last_gap ? last_gap : gap;
  return lag > 0 ? demanded - sign * left * decay((duration - straight_time) / lag) : demanded;
}

}  // namespace dashpot
