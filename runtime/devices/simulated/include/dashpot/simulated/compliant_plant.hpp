// The mechanics of a simulated device whose structure gives, between samples, in the joint's coordinate: the shaft at q
// with motor, brake, encoder, friction and the device's own damping, the tool at y with hand and end-stops,
//     (J − m) q̈ = τ(t) − (c + b(t, q̇)) q̇ − friction + f,     (m + m_hand) ÿ = f_hand − stops − f,
//     f = k (y − q ∓ g/2) + c_m (ẏ − q̇) where the structure is engaged, 0 within its backlash g,
// where k and c_m are those of the mode (device_description.hpp), μ = m (J − m)/J:
//     k = μ (2π f_mode)²,     c_m = 2 ζ μ · 2π f_mode.
// Engaged by backlash the structure pushes and never pulls. Integrated as plant.hpp says; a change of friction,
// backlash or stops ends a step at the instant it happens.
#pragma once

#include <dashpot/simulated/stepped_plant.hpp>

namespace dashpot::simulated {

class compliant_plant : public stepped_plant<compliant_plant> {
 public:
  // Requires a mode with 0 < mass < inertia, no rigid end-stop and no prescribed motion.
  compliant_plant(const device_description& device, const scenario& scene);

  plant_view view() const noexcept;

 private:
  friend stepped_plant;

  // A step that may yet be refused, because an event lies within it.
  struct step {
    double duration = 0;  // [s]
    shaft_motion shaft;   // at its end
    shaft_motion tool;    // likewise
    hand_state grip;      // likewise
    energy_ledger work;   // over it
  };
  // The two instants within a step at which forces are balanced.
  struct stages {
    double torque[2];   // of the motor [N·m] or [N]
    double damping[2];  // of the brake [N·m·s/rad] or [N·s/m]
    double grip[2];     // of the hand without its mass, the tool at rest [N·m] or [N]
    double shaft[2];    // velocities [rad/s] or [m/s]
    double tool[2];
  };
  // Linear in the four stage velocities: the shaft's, then the tool's.
  struct stage_equations {
    double matrix[4][4] = {};  // [N·m·s/rad] or [N·s/m]
    double right[4] = {};      // [N·m] or [N]
  };

  void commit(const step& done, shaft_sensors& sensors) noexcept;
  step attempt(double duration, const hand_step& grip) const noexcept;
  stage_equations equations(const stages& s, const hand_step& grip, double duration) const noexcept;
  void couple(stage_equations& e, double duration) const noexcept;
  void balance(stages& s, const stage_equations& without_brake) const noexcept;
  void add_work(const stages& s, const hand_step& grip, step& done) const noexcept;

  bool is_consistent(const step& candidate) const noexcept;
  void settle() noexcept;
  void settle_under_demand() noexcept { settle(); }
  int would_engage(const shaft_motion& shaft, const shaft_motion& tool) const noexcept;
  double structure_force(const shaft_motion& shaft, const shaft_motion& tool) const noexcept;

  bool is_engaged() const noexcept { return half_backlash_ == 0 || side_ != 0; }
  double stiffness() const noexcept { return is_engaged() ? stiffness_ : 0; }
  double structure_damping() const noexcept { return is_engaged() ? structure_damping_ : 0; }
  double offset() const noexcept { return side_ * half_backlash_; }
  double kinetic() const noexcept;

  double shaft_inertia_;      // J − m
  double stiffness_;          // k [N·m/rad] or [N/m]
  double structure_damping_;  // c_m [N·m·s/rad] or [N·s/m]
  double half_backlash_;      // g/2 [rad] or [m]

  shaft_motion tool_;
  bool stuck_ = false;
  int side_ = 0;  // on which backlash is taken up: +1 where the tool is ahead; 0: neither, or no backlash
};

}  // namespace dashpot::simulated
