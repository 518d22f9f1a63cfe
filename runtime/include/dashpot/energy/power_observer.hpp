// The paper's passivity observer, (20): E ← E + f_k v_k Δt (Hannaford & Ryu 2002), for comparison. It approximates what
// hold_observer counts exactly: the force acts from the sample on, the velocity is an estimate from before it.
#pragma once

#include <dashpot/energy/compensated_sum.hpp>

namespace dashpot {

template <class Scalar>
class power_observer {
 public:
  // `force` opposes +u [N] or [N·m]; `velocity` [m/s] or [rad/s]; `period` [s].
  constexpr void observe(Scalar force, Scalar velocity, Scalar period) noexcept {
    energy_.add(force * velocity * period);
  }
  constexpr Scalar energy() const noexcept { return energy_.value(); }  // [J]; positive: absorbed from the tool
  constexpr void reset() noexcept { energy_ = {}; }

 private:
  compensated_sum<Scalar> energy_;
};

}  // namespace dashpot
