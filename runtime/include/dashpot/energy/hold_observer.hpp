// The energy that has crossed the tool since reset(), counted hold by hold (theory.md, section 6(c)).
//
// The motor holds the force m_k while the tool moves from u_k to u_{k+1}, so without any velocity, and exactly,
//     E ← E + m_k (u_{k+1} − u_k),
// positive where energy flowed from the tool into the motor (sign of command.hpp). What the brake dissipated is added
// as a lower bound (brake_dissipation.hpp). The rendering has given away no energy that it did not receive while
//     balance = motor_energy + brake_energy ≥ 0.
// Where a device tells what it made of a command, by the command's number, tell() puts that in the command's place.
// Exact for the positions given: an encoder's step q moves the motor's part by q (|m_0| + |m_n| + Σ|m_k − m_{k−1}|) at
// most. Amplifier lag is not seen, nor that a command acts within a sample. No heap, no <cmath>.
#pragma once

#include <dashpot/device_description.hpp>
#include <dashpot/energy/brake_dissipation.hpp>
#include <dashpot/energy/compensated_sum.hpp>

namespace dashpot {

template <class Scalar, unsigned MaxDelay = most_delay_samples>
class hold_observer {
 public:
  // `delay_samples`: whole samples from hold() until a command takes effect; they count observe() calls. With more than
  // MaxDelay nothing is known of the energy, and the balance is −∞.
  // `quantum`: the encoder's step at the tool [m] or [rad].
  explicit constexpr hold_observer(unsigned delay_samples = 0, Scalar quantum = 0) noexcept
      : delay_(delay_samples < MaxDelay ? delay_samples : MaxDelay),
        beyond_(delay_samples > MaxDelay),
        brake_(quantum) {}

  // At rest there, no command in effect.
  constexpr void reset(Scalar position) noexcept {
    for (applied& slot : line_) slot = {};
    motor_ = {};
    brake_.reset(position);
    position_ = position;
  }

  // With every sample, before hold(): closes the hold that has just ended after `duration` [s].
  constexpr void observe(Scalar position, Scalar duration) noexcept {
    const applied& held = line_[delay_];
    motor_.add(held.force * (position - position_));
    brake_.observe(position, held.damping, duration);
    position_ = position;
    for (unsigned slot = delay_; slot > 0; --slot) line_[slot] = line_[slot - 1];
  }

  // With every command that leaves: the force opposing +u that the motor holds [N] or [N·m], and the damping that the
  // brake has at least [N·s/m] or [N·m·s/rad] (actuator_output: applied_force, assured_damping). Without a call the
  // last command stays. `number` counts commands, for tell(), and wraps around.
  constexpr void hold(Scalar force, Scalar damping, unsigned number = 0) noexcept {
    line_[0] = {force, damping, number, true};
  }

  // Before the observe() of a sample in which the device tells that the command `number` is the newest in force, with
  // this force, and whether the brake does what was asked. A hold that should have had a newer command, which was lost
  // or late, had this one.
  constexpr void tell(unsigned number, Scalar force, bool brake_obeys) noexcept {
    for (unsigned slot = 0; slot <= delay_; ++slot) {
      if (!line_[slot].numbered || is_newer(line_[slot].number, number)) continue;
      correct(line_[slot], force, brake_obeys);
      break;
    }
    applied& closing = line_[delay_];
    if (closing.numbered && is_newer(closing.number, number)) correct(closing, force, false);
  }

  constexpr Scalar motor_energy() const noexcept {
    return beyond_ ? -infinity : motor_.value();
  }                                                                          // [J]; negative: the motor gave it away
  constexpr Scalar brake_energy() const noexcept { return brake_.value(); }  // [J] dissipated, at least
  constexpr Scalar balance() const noexcept { return motor_energy() + brake_energy(); }  // [J]

 private:
  struct applied {
    Scalar force = 0;
    Scalar damping = 0;
    unsigned number = 0;
    bool numbered = false;
  };

  static constexpr Scalar infinity = static_cast<Scalar>(__builtin_huge_val());

  static constexpr bool is_newer(unsigned one, unsigned other) noexcept { return static_cast<int>(one - other) > 0; }
  static constexpr void correct(applied& held, Scalar force, bool brake_obeys) noexcept {
    held.force = force;
    if (!brake_obeys) held.damping = 0;
  }

  unsigned delay_;
  bool beyond_;
  applied line_[MaxDelay + 1];  // [0]: the newest command
  compensated_sum<Scalar> motor_;
  brake_dissipation<Scalar> brake_;
  Scalar position_ = 0;
};

}  // namespace dashpot
