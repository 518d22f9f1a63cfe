// The loop's energy: counted hold by hold after the command has left, or, where the brake is to pay for what the motor
// creates, before it (theory.md, section 6(c)).
#pragma once

#include <dashpot/actuator.hpp>
#include <dashpot/command.hpp>
#include <dashpot/device_description.hpp>
#include <dashpot/energy/brake_controller.hpp>
#include <dashpot/energy/hold_observer.hpp>
#include <dashpot/transmission.hpp>

namespace dashpot {

enum class energy_policy : unsigned char {
  observe,      // the model's command leaves as it is
  raise_brake,  // the brake is raised, within its limits, before more energy comes out than has gone in
};

class energy_account {
 public:
  constexpr energy_account(const device_description& device, const transmission<double>& gear,
                           energy_policy policy) noexcept
      : observer_(device.loop.delay_samples, gear.tool_motion(device.encoder.step)),
        controller_(gear.tool_damping(limit_of(device.brake)), device.brake.tolerance),
        sample_period_(device.loop.sample_period),
        policy_(policy) {}

  constexpr void reset(double position) noexcept { observer_.reset(position); }

  // Before the command leaves: what to send for what the model `wanted`, all at the tool. `duration` [s] is that of the
  // hold that ends with this sample.
  constexpr command<double> control(const command<double>& wanted, double position, double velocity,
                                    double duration) noexcept {
    if (policy_ == energy_policy::observe) return wanted;
    observer_.observe(position, duration);
    const double displacement = velocity * sample_period_;
    return {controller_.raise(wanted, observer_.balance(), displacement, sample_period_), wanted.force};
  }

  // After it has left, where control() has not done it.
  constexpr void observe(double position, double duration) noexcept {
    if (policy_ == energy_policy::observe) observer_.observe(position, duration);
  }

  // What motor and brake do over the coming hold: a force opposing +u [N] or [N·m], and the damping that the brake has
  // at least [N·s/m] or [N·m·s/rad].
  constexpr void hold(double force, double damping, unsigned number = 0) noexcept {
    observer_.hold(force, damping, number);
  }

  // What the device tells of the command `number`, with the sample that ends the hold: before control() and observe().
  constexpr void tell(unsigned number, double force, bool brake_obeys) noexcept {
    observer_.tell(number, force, brake_obeys);
  }

  // Taken from the tool by motor and brake until the newest sample, at least; below zero: given to it [J].
  constexpr double balance() const noexcept { return observer_.balance(); }

 private:
  static constexpr double limit_of(const brake_description& brake) noexcept {
    return brake.kind == brake_kind::none ? 0 : brake.max_damping;
  }

  hold_observer<double> observer_;
  brake_controller<double> controller_;
  double sample_period_;  // [s]
  energy_policy policy_;
};

}  // namespace dashpot
