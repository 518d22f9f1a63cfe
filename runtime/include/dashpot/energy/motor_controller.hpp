// The classical time-domain passivity controller, which makes the motor a damper (Hannaford & Ryu 2002, the series
// controller of an impedance display), to compare with brake_controller.hpp:
//     W_k = W_{k−1} + α_{k−1} v_{k−1}² Δt + f_k v_k Δt,    α_k = (−W_k)⁺/(v_k² Δt),    f′_k = f_k + α_k v_k.
// It needs a velocity, whose noise it passes on to the force, and its force acts after the motion that v_k measured.
// `max_damping` caps α: a sampled damper above twice the inertia per period is itself unstable. No heap, no <cmath>.
#pragma once

#include <dashpot/energy/compensated_sum.hpp>

namespace dashpot {

template <class Scalar>
class motor_controller {
 public:
  explicit constexpr motor_controller(Scalar max_damping) noexcept  // [N·s/m] or [N·m·s/rad]
      : max_damping_(max_damping) {}

  // The force to apply [N] or [N·m] in place of `force`, both opposing +u; `velocity` [m/s] or [rad/s]; `period` [s].
  constexpr Scalar limit(Scalar force, Scalar velocity, Scalar period) noexcept {
    energy_.add(force * velocity * period);
    const Scalar action = velocity * velocity * period;
    const Scalar damping = needed(action);
    energy_.add(damping * action);
    return force + damping * velocity;
  }

  constexpr Scalar energy() const noexcept { return energy_.value(); }  // W with the controller's part [J]
  constexpr void reset() noexcept { energy_ = {}; }

 private:
  constexpr Scalar needed(Scalar action) const noexcept {
    const Scalar debt = -energy_.value();
    if (!(debt > 0) || !(action > 0)) return 0;
    return debt < max_damping_ * action ? debt / action : max_damping_;
  }

  Scalar max_damping_;
  compensated_sum<Scalar> energy_;
};

}  // namespace dashpot
