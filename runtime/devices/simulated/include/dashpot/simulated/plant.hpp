// The mechanics of a simulated device between samples, in the joint's coordinate:
//     (J + m) q̈ = τ(t) + f_hand − (c + b(t, q̇)) q̇ − friction − stops.
// The motion is integrated by Gauss's collocation of order 4 (gauss.hpp), the actuators are exact (drives.hpp).
// Coulomb friction and stops are no smooth forces: the shaft either slides or is stuck, with a velocity of exactly
// zero, and every change between the two, and every touch and release of a stop, ends a step at the instant it happens.
#pragma once

#include <dashpot/simulated/stepped_plant.hpp>

namespace dashpot::simulated {

class plant : public stepped_plant<plant> {
 public:
  plant(const device_description& device, const scenario& scene);

  plant_view view() const noexcept;

 private:
  friend stepped_plant;

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

  void commit(const step& done, shaft_sensors& sensors) noexcept;
  step attempt(double duration, const hand_step& grip) const noexcept;
  step follow(double duration) const noexcept;
  step stay(double duration, const hand_step& grip) const noexcept;
  step slide(double duration, const hand_step& grip) const noexcept;
  stage_equations equations(const stages& s, const hand_step& grip, double duration) const noexcept;
  void balance(stages& s, const stage_equations& without_brake) const noexcept;
  void add_sliding_work(const stages& s, const hand_step& grip, step& done) const noexcept;

  bool is_consistent(const step& candidate) const noexcept;
  void settle() noexcept;
  void settle_under_demand() noexcept {
    if (direction_ == 0) settle();
  }
  void land(const stop_contact& stop) noexcept;
  bool can_hold(double position, double force) const noexcept;

  double inertia() const noexcept { return mechanics_.inertia + user_.mass; }
  double kinetic(double velocity) const noexcept { return mechanics_.inertia * velocity * velocity / 2; }
  double force_at_rest(const shaft_motion& shaft, const hand_state& grip, double torque) const noexcept;

  bool prescribed_;
};

}  // namespace dashpot::simulated
