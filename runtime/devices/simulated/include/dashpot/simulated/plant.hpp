// The mechanics of a simulated device between samples, in the joint's coordinate:
//     (J + m) q̈ = τ(t) + f_hand − (c + b(t, q̇)) q̇ − friction − stops.
// The motion is integrated by Gauss's collocation of order 4 (gauss.hpp), the actuators are exact (drives.hpp).
// Coulomb friction and stops are no smooth forces: the shaft either slides or is stuck, with a velocity of exactly
// zero, and every change between the two, and every touch and release of a stop, ends a step at the instant it happens.
#pragma once

#include <dashpot/device.hpp>
#include <dashpot/device_description.hpp>
#include <dashpot/simulated/drives.hpp>
#include <dashpot/simulated/energy_ledger.hpp>
#include <dashpot/simulated/hand_step.hpp>
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

class plant {
 public:
  plant(const device_description& device, const scenario& scene);

  // Goes on by `duration` [s], to the instant `end` [s], under `demand`, which must be finite; `sensors` see every
  // step. The caller knows both without accumulated rounding; equal durations are faster than merely similar ones.
  void advance(double duration, double end, const actuation& demand, shaft_sensors& sensors) noexcept;

  // Of the motor until the next, beside what is asked for [N·m] or [N].
  void disturb(double torque) noexcept { drives_.disturb(torque); }

  shaft_motion shaft() const noexcept { return shaft_; }
  const energy_ledger& ledger() const noexcept { return ledger_; }
  plant_view view() const noexcept;
  plant_view view_under(const actuation& demand) const noexcept;  // at the same instant, once that has been demanded

 private:
  // A step that may yet be refused, because an event lies within it.
  struct step {
    double duration = 0;  // [s]
    shaft_motion shaft;   // at its end
    hand_state grip;      // at its end
    energy_ledger work;   // over it
  };
  // The two instants within a step at which forces are balanced.
  struct stages {
    double torque[2];    // of the motor [N·m] or [N]
    double damping[2];   // of the brake [N·m·s/rad] or [N·s/m]
    double grip[2];      // of the hand without its mass, the shaft at rest [N·m] or [N]
    double velocity[2];  // [rad/s] or [m/s]
  };
  // Linear in the two stage velocities.
  struct stage_equations {
    double matrix[2][2];  // [N·m·s/rad] or [N·s/m]
    double right[2];      // [N·m] or [N]
  };

  void integrate_evenly(double duration, shaft_sensors& sensors) noexcept;
  void integrate(double duration, shaft_sensors& sensors) noexcept;
  void commit(const step& done, shaft_sensors& sensors) noexcept;

  step attempt(double duration) const noexcept;
  step follow(double duration) const noexcept;
  step hold_or_slide(double duration, const hand_step& grip) const noexcept;
  step stay(double duration, const hand_step& grip) const noexcept;
  step slide(double duration, const hand_step& grip) const noexcept;
  stage_equations equations(const stages& s, const hand_step& grip, double duration) const noexcept;
  void balance(stages& s, const stage_equations& without_brake) const noexcept;
  void add_sliding_work(const stages& s, const hand_step& grip, step& done) const noexcept;

  double first_event(double duration) const noexcept;
  bool is_consistent(const step& candidate) const noexcept;
  void settle() noexcept;
  void land(const stop_contact& stop) noexcept;
  bool can_hold(double position, double force) const noexcept;

  motion_point intended(double time) const noexcept;
  double inertia() const noexcept { return mechanics_.inertia + user_.mass; }
  double kinetic(double velocity) const noexcept { return mechanics_.inertia * velocity * velocity / 2; }
  double stop_force(double position, double velocity) const noexcept;
  double force_at_rest(const shaft_motion& shaft, const hand_state& grip, double torque) const noexcept;

  mechanics_description mechanics_;
  drives drives_;
  double ratio_;         // tool motion over joint motion
  hand user_;            // in the joint's coordinate
  trajectory intended_;  // in the tool's
  bool prescribed_;
  stop_contact low_;
  stop_contact high_;
  double longest_step_;  // [s]

  shaft_motion shaft_;
  hand_state grip_;
  hand_step usual_grip_;  // for the step length in use
  double direction_ = 0;  // of sliding: +1 or −1; 0: stuck
  double kinetic_at_start_;
  energy_ledger ledger_;
};

}  // namespace dashpot::simulated
