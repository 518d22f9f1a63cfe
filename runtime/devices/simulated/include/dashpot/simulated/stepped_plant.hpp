// What the plants of one shaft share: hand, drives and stops, and how they go on over a duration: in equal steps, each
// cut into pieces where an event lies within it.
//
// A Plant derives from stepped_plant<Plant> and gives: attempt(duration, grip), a step that may yet be refused;
// is_consistent(step), whether it has ended in the same state of sticking, sliding and touching as it began in;
// commit(step, sensors); settle(), what happens at an event; settle_under_demand(), at a change of the demand.
#pragma once

#include <algorithm>
#include <cmath>

#include <dashpot/device.hpp>
#include <dashpot/device_description.hpp>
#include <dashpot/simulated/drives.hpp>
#include <dashpot/simulated/energy_ledger.hpp>
#include <dashpot/simulated/hand_step.hpp>
#include <dashpot/simulated/longest_step.hpp>
#include <dashpot/simulated/scenario.hpp>
#include <dashpot/simulated/shaft_sensors.hpp>
#include <dashpot/simulated/stop_contact.hpp>

namespace dashpot::simulated {

// All that acts at the joint at one instant, in its own coordinate; torques in [N·m] or [N].
struct plant_view {
  double time = 0;             // [s]
  double position = 0;         // [rad] or [m]
  double velocity = 0;         // [rad/s] or [m/s]; exactly 0 while stuck
  double motor_torque = 0;     // behind the amplifier, along +q
  double brake_damping = 0;    // true, with gain, residual and speed [N·m·s/rad] or [N·s/m]
  double hand_torque = 0;      // by the hand on the device, along +q; 0 in a prescribed motion, where it is not known
  double friction_torque = 0;  // opposing +q; while stuck, what holds the shaft, a rigid stop included
  double stop_torque = 0;      // by compliant stops, opposing +q
  bool stuck = false;
  double tool_position = 0;  // seen from the joint; the shaft's own where the structure is rigid [rad] or [m]
  double tool_velocity = 0;  // [rad/s] or [m/s]
};

template <class Plant>
class stepped_plant {
 public:
  // Goes on by `duration` [s], to the instant `end` [s], under `demand`, which must be finite; `sensors` see every
  // step. The caller knows both without accumulated rounding; equal durations are faster than merely similar ones.
  void advance(double duration, double end, const actuation& demand, shaft_sensors& sensors) noexcept {
    drives_.demand(demand);
    self().settle_under_demand();
    const double held = user_.release_time - shaft_.time;
    if (held < duration) {
      integrate_evenly(std::max(held, 0.0), sensors);
      duration -= std::max(held, 0.0);
      user_ = no_hand();
      usual_grip_ = {};
      self().settle();
    }
    integrate_evenly(duration, sensors);
    shaft_.time = end;
  }

  // A disturbance of the motor, in addition to its command, until the next call [N·m] or [N].
  void disturb(double torque) noexcept { drives_.disturb(torque); }

  shaft_motion shaft() const noexcept { return shaft_; }
  const energy_ledger& ledger() const noexcept { return ledger_; }

  // At the same instant, once `demand` has been demanded.
  plant_view view_under(const actuation& demand) const noexcept {
    drives next = drives_;
    next.demand(demand);
    plant_view now = self().view();
    now.motor_torque = next.torque();
    now.brake_damping = next.at_speed(next.damping_after(0), shaft_.velocity);
    return now;
  }

 protected:
  stepped_plant(const device_description& device, const scenario& scene)
      : mechanics_(device.mechanics),
        drives_(device, scene),
        ratio_(tool_over_joint(device, scene)),
        user_(scene.prescribed ? no_hand() : at_joint(scene.user, ratio_)),
        intended_(scene.intended),
        low_(scene.low, -1, ratio_),
        high_(scene.high, +1, ratio_),
        longest_step_(longest_step(device, scene, user_, ratio_)) {}

  // All of a view that shaft and drives tell.
  plant_view view_of_shaft() const noexcept {
    plant_view seen;
    seen.time = shaft_.time;
    seen.position = seen.tool_position = shaft_.position;
    seen.velocity = seen.tool_velocity = shaft_.velocity;
    seen.motor_torque = drives_.torque();
    seen.brake_damping = drives_.at_speed(drives_.damping(), shaft_.velocity);
    return seen;
  }

  motion_point intended(double time) const noexcept {
    if (!intended_) return {};
    const motion_point tool = intended_(time);
    return {tool.position / ratio_, tool.velocity / ratio_};
  }

  double stop_force(double position, double velocity) const noexcept {
    return low_.force(position, velocity) + high_.force(position, velocity);
  }

  mechanics_description mechanics_;
  drives drives_;
  double ratio_;         // tool motion over joint motion
  hand user_;            // in the joint's coordinate
  trajectory intended_;  // in the tool's
  stop_contact low_;
  stop_contact high_;
  double longest_step_;  // [s]

  shaft_motion shaft_;
  hand_state grip_;
  hand_step usual_grip_;  // for the step length in use
  double direction_ = 0;  // of sliding: +1 or −1; 0: stuck, or without friction
  double kinetic_at_start_ = 0;
  energy_ledger ledger_;

 private:
  Plant& self() noexcept { return static_cast<Plant&>(*this); }
  const Plant& self() const noexcept { return static_cast<const Plant&>(*this); }

  auto attempt(double duration) const noexcept {
    if (duration == usual_grip_.duration()) return self().attempt(duration, usual_grip_);
    return self().attempt(duration, hand_step(user_, duration));
  }

  void integrate_evenly(double duration, shaft_sensors& sensors) noexcept {
    const double steps = std::ceil(duration / longest_step_ - 1e-6);
    for (double done = 0; done < steps; ++done) integrate(duration / steps, sensors);
  }

  void integrate(double duration, shaft_sensors& sensors) noexcept {
    if (usual_grip_.duration() != duration) usual_grip_ = hand_step(user_, duration);
    constexpr int most_events = 64;  // only an upper bound: a step sees one or two
    for (int events = 0; events < most_events; ++events) {
      const auto whole = attempt(duration);
      if (self().is_consistent(whole)) return self().commit(whole, sensors);
      const double until = first_event(duration);
      self().commit(attempt(until), sensors);
      self().settle();
      duration -= until;
      if (!(duration > 0)) return;  // it was at the very end
    }
    self().commit(attempt(duration), sensors);
  }

  // The shortest time, to a billionth of `duration`, after which the step is no longer consistent.
  double first_event(double duration) const noexcept {
    double before = 0, after = duration;
    while (after - before > 1e-9 * duration) {
      const double middle = (before + after) / 2;
      (self().is_consistent(attempt(middle)) ? before : after) = middle;
    }
    return after;
  }
};

}  // namespace dashpot::simulated
