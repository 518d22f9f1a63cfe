// From an update law's command at the tool to what the device's motor and brake are asked to do, once a period.
//
//     torque = r F,   B_joint = r² B,   i = √(b/κ)                                     (theory.md, section 7)
// within max_damping and max_torque. What a limit took away is reported, so that the safety monitor can count
// saturation, and so is how far the coil, with its slew and lag, stays behind. That is predicted (brake_coil.hpp) from
// the demands made here. The energy observer may count the predicted damping as dissipated, and the motor may make up
// for what the coil lacks. The residual damping at zero current comes on top of all figures here and is never
// subtracted: it belongs to the device's own.
// No heap, no <cmath>; `Scalar` is float or double. Commands must be finite: the safety monitor refuses others before.
#pragma once

#include <dashpot/brake_coil.hpp>
#include <dashpot/command.hpp>
#include <dashpot/device.hpp>
#include <dashpot/device_description.hpp>
#include <dashpot/transmission.hpp>

namespace dashpot {

struct actuator_options {
  // The motor adds (b_commanded − b_actual)·v̂ while the coil lags. Better fidelity, but not covered by any passivity
  // statement: while the brake rises it is a virtual damper, which a late v̂ makes active. While the brake falls, what
  // it takes away stays below the damping that is assured through the coming hold.
  bool make_up_with_motor = false;
  // The coil is driven beyond the commanded current, within its limits, to arrive at the end of the period.
  bool lead_coil = false;
};

// One period's commands. "Joint" is the device's coordinate, "tool" the network's.
template <class Scalar>
struct actuator_output {
  Scalar motor_torque = 0;     // along +q, joint [N·m] or [N]
  Scalar motor_current = 0;    // [A]; 0 where the torque constant is not stated
  Scalar brake_damping = 0;    // demanded of the brake, joint [N·m·s/rad] or [N·s/m]
  Scalar coil_current = 0;     // [A]; 0 where κ is not stated
  Scalar torque_clipped = 0;   // wanted minus given, joint [N·m] or [N]; 0: not saturated
  Scalar damping_clipped = 0;  // wanted minus what max_damping allows, joint
  Scalar damping_behind = 0;   // allowed minus what the coil has reached at the end of the period, joint; either sign
  Scalar applied_force = 0;    // what the motor makes after its limits, tool, opposing +u [N] or [N·m]
  Scalar assured_damping = 0;  // ∫b v² dt ≥ assured_damping·Δu²/Δt over the coming hold, tool [N·s/m] or [N·m·s/rad]

  constexpr bool motor_saturated() const noexcept { return torque_clipped != 0; }
  constexpr actuation demand() const noexcept {
    return {static_cast<double>(motor_torque), static_cast<double>(brake_damping)};
  }
};

template <class Scalar>
class actuator {
 public:
  // Requires can_drive(device, network).
  constexpr actuator(const device_description& device, motion network, actuator_options options = {}) noexcept
      : transmission_(device, network),
        coil_(device.brake),
        options_(options),
        period_(static_cast<Scalar>(device.loop.sample_period)),
        max_torque_(static_cast<Scalar>(device.motor.max_torque)),
        torque_constant_(static_cast<Scalar>(device.motor.torque_constant)),
        max_damping_(static_cast<Scalar>(limit_of(device.brake))),
        max_root_(square_root(max_damping_)),
        per_root_(reciprocal(square_root(static_cast<Scalar>(device.brake.damping_per_current_squared)))),
        tolerance_(static_cast<Scalar>(device.brake.tolerance)) {}

  constexpr const transmission<Scalar>& gear() const noexcept { return transmission_; }

  // `velocity`: the estimate v̂ at the tool [m/s] or [rad/s]; read only where the motor makes up for the coil. Predicts
  // the coil over the coming period.
  constexpr actuator_output<Scalar> drive(const command<Scalar>& wanted, Scalar velocity) noexcept {
    actuator_output<Scalar> output;
    const Scalar before = coil_.root_damping();
    demand_damping(wanted.damping, output);
    output.assured_damping = transmission_.tool_damping(assured(before, coil_.root_damping()));
    const Scalar make_up = options_.make_up_with_motor ? make_up_force(wanted.damping, before, velocity) : Scalar(0);
    demand_torque(wanted.force + make_up, output);
    return output;
  }

  // The coil has settled at `brake_damping`, joint: 0, or the safe damping of a device that comes from its safe state.
  constexpr void reset(Scalar brake_damping = 0) noexcept {
    coil_.reset(square_root(clamp(brake_damping, 0, max_damping_)));
  }

 private:
  static constexpr double limit_of(const brake_description& brake) noexcept {
    return brake.kind == brake_kind::none ? 0 : brake.max_damping;
  }
  static constexpr Scalar reciprocal(Scalar value) noexcept { return value > 0 ? 1 / value : Scalar(0); }
  static constexpr Scalar clamp(Scalar value, Scalar low, Scalar high) noexcept {
    return value < low ? low : value > high ? high : value;
  }

  constexpr void demand_damping(Scalar tool_damping, actuator_output<Scalar>& output) noexcept {
    const Scalar wanted = transmission_.joint_damping(tool_damping);
    const Scalar allowed = clamp(wanted, 0, max_damping_);
    const Scalar root = square_root(allowed);
    const Scalar demanded = options_.lead_coil ? clamp(coil_.demand_to_reach(root, period_), 0, max_root_) : root;
    coil_.advance(demanded, period_);
    // The square of a rounded root may lie above what it is the root of.
    output.brake_damping = options_.lead_coil ? clamp(demanded * demanded, 0, max_damping_) : allowed;
    output.coil_current = demanded * per_root_;
    output.damping_clipped = wanted - allowed;
    output.damping_behind = allowed - coil_.damping();
  }

  // With √b going from s₀ to s₁: rising, it lies above its chord, and ∫b v² dt ≥ Δu²/∫dt/b ≥ s₀ s₁ Δu²/Δt (Cauchy and
  // Schwarz). Falling, it lies below the chord but above s₁.
  constexpr Scalar assured(Scalar before, Scalar after) const noexcept {
    return (1 - tolerance_) * after * (before < after ? before : after);
  }

  constexpr Scalar make_up_force(Scalar tool_damping, Scalar before, Scalar velocity) const noexcept {
    const Scalar after = coil_.root_damping();
    const Scalar mean = (before * before + before * after + after * after) / 3;
    const Scalar reachable = clamp(transmission_.joint_damping(tool_damping), 0, max_damping_);
    const Scalar most_taken = assured(before, after);
    return transmission_.tool_damping(clamp(reachable - mean, -most_taken, reachable)) * velocity;
  }

  constexpr void demand_torque(Scalar tool_force, actuator_output<Scalar>& output) const noexcept {
    const Scalar wanted = -transmission_.joint_torque(tool_force);
    const Scalar given = max_torque_ > 0 ? clamp(wanted, -max_torque_, max_torque_) : wanted;
    output.motor_torque = given;
    output.motor_current = given * reciprocal(torque_constant_);
    output.torque_clipped = wanted - given;
    output.applied_force = -transmission_.tool_force(given);
  }

  transmission<Scalar> transmission_;
  brake_coil<Scalar> coil_;
  actuator_options options_;
  Scalar period_;           // [s]
  Scalar max_torque_;       // [N·m] or [N]; 0: unlimited
  Scalar torque_constant_;  // [N·m/A] or [N/A]; 0: not stated
  Scalar max_damping_;      // joint [N·m·s/rad] or [N·s/m]
  Scalar max_root_;         // its square root
  Scalar per_root_;         // coil current per √b: 1/√κ; 0: not stated
  Scalar tolerance_;        // ε of the brake
};

}  // namespace dashpot
