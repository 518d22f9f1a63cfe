// The coil of a programmable brake: what the brake's damping does after a new one is demanded.
//
// b = κ i², so the state kept here is √b = √κ·i, which is proportional to the coil's current and
// to its magnetic field. Under a constant demand it obeys
//     d√b/dt = clamp((√b_demanded − √b)/lag, ±slew),     slew = √κ · (V/L),
// which is solved exactly: straight while the rail voltage limits it, exponential afterwards. Where κ is not stated the
// current is not known, and neither is its slew limit: only the lag acts. No heap, no <cmath>; total for finite input.
#pragma once

#include <dashpot/device_description.hpp>
#include <dashpot/elementary.hpp>

namespace dashpot {

template <class Scalar>
class brake_coil {
 public:
  constexpr brake_coil() noexcept = default;  // no brake: follows at once
  explicit constexpr brake_coil(const brake_description& brake) noexcept
      : lag_(static_cast<Scalar>(brake.coil_lag)),
        slew_(static_cast<Scalar>(brake.slew) * square_root(static_cast<Scalar>(brake.damping_per_current_squared))) {}

  constexpr Scalar root_damping() const noexcept { return root_; }     // √b [√(N·s/m)] or [√(N·m·s/rad)]
  constexpr Scalar damping() const noexcept { return root_ * root_; }  // b = κ i² [N·s/m] or [N·m·s/rad]
  constexpr Scalar slew() const noexcept { return slew_; }             // of √b [√(N·s/m)/s]; 0: unlimited

  // √b when `duration` [s] has passed under the constant demand `demanded` (a √b, as everywhere in this class).
  constexpr Scalar after(Scalar demanded, Scalar duration) const noexcept {
    const Scalar sign = demanded < root_ ? Scalar(-1) : Scalar(1);
    const Scalar gap = sign * (demanded - root_);
    const Scalar straight_gap = slew_ * lag_;
    if (!(slew_ > 0) || gap <= straight_gap) return settle(demanded, sign * gap, duration);
    const Scalar straight_time = (gap - straight_gap) / slew_;
    if (duration <= straight_time) return root_ + sign * slew_ * duration;
    return settle(demanded, sign * straight_gap, duration - straight_time);
  }

  constexpr void advance(Scalar demanded, Scalar duration) noexcept { root_ = after(demanded, duration); }
  constexpr void reset(Scalar root_damping) noexcept { root_ = root_damping; }

  // The demand under which √b arrives at `wanted` at the end of `duration`, were there no slew limit. May be negative
  // or beyond any brake: the caller clamps it.
  constexpr Scalar demand_to_reach(Scalar wanted, Scalar duration) const noexcept {
    if (!(lag_ > 0)) return wanted;
    return root_ + (wanted - root_) / (1 - decay(duration / lag_));
  }

 private:
  constexpr Scalar settle(Scalar demanded, Scalar gap, Scalar duration) const noexcept {
    return lag_ > 0 && gap != 0 ? demanded - gap * decay(duration / lag_) : demanded;
  }

  Scalar root_ = 0;
  Scalar lag_ = 0;   // [s]
  Scalar slew_ = 0;  // [√(N·s/m)/s]
};

}  // namespace dashpot
