// The passivity controller of a device with a brake, from cycle to cycle: it raises the brake so that it dissipates
// what the motor has created or is about to create (theory.md, section 6(c); Gosline & Hayward 2008).
//
// A debt is an energy that should be there and is not. The brake repays it in the hold that begins now, over which the
// tool is expected to move by Δu, with the least damping for which b Δu²/Δt covers the debt. It never goes below the
// damping that the model wants, and never touches the motor. What the brake cannot give at once, for its limit or its
// coil, stays in the balance of hold_observer and is sought again in the next period. No heap, no <cmath>, no state.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot {

template <class Scalar>
class brake_controller {
 public:
  // The brake's greatest damping [N·s/m] or [N·m·s/rad], at the tool, and its tolerance ε: 1/(1 − ε) more is demanded.
  constexpr brake_controller(Scalar max_damping, Scalar tolerance) noexcept
      : max_damping_(max_damping), assured_share_(1 - tolerance) {}

  // The damping to demand so that no more energy ever comes out than has gone in: W + m Δu + b Δu²/Δt ≥ 0 at the end of
  // the hold. Lets a network give back more than it should while it still owes from before, and so reacts late.
  //   balance       W [J], hold_observer::balance()
  //   displacement  Δu expected over the hold [m] or [rad]: v̂Δt, or the last one
  //   duration      Δt of the hold [s]
  constexpr Scalar raise(const command<Scalar>& wanted, Scalar balance, Scalar displacement,
                         Scalar duration) const noexcept {
    return repay(wanted.damping, -balance - wanted.force * displacement, displacement, duration);
  }

  // The damping to demand so that never more comes out than the network has stored, W ≥ V: reacts to every hold that
  // created energy, in the next one.
  //   stored  V [J], the model's stored_energy() less what it was when the observer was reset
  constexpr Scalar raise_to_stored(const command<Scalar>& wanted, Scalar balance, Scalar stored, Scalar displacement,
                                   Scalar duration) const noexcept {
    return repay(wanted.damping, stored - balance, displacement, duration);
  }

 private:
  constexpr Scalar repay(Scalar wanted, Scalar debt, Scalar displacement, Scalar duration) const noexcept {
    if (!(debt > 0)) return wanted;
    const Scalar action = assured_share_ * displacement * displacement;
    // Compared before dividing: at rest the action is zero, and any brake is as good as the strongest.
    const Scalar needed = debt * duration < max_damping_ * action ? debt * duration / action : max_damping_;
    return needed > wanted ? needed : wanted;
  }

  Scalar max_damping_;
  Scalar assured_share_;  // 1 − ε
};

}  // namespace dashpot
