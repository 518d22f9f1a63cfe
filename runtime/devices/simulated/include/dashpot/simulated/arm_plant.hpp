// The mechanics of a simulated arm between samples:
//     M(q) q̈ + c(q, q̇) + f sgn q̇ + d q̇ + Σ b_i(t, a_i·q̇) (a_i·q̇) a_i = τ(t) + Jᵀ F_hand.
// M and c are those of uniform links (arm_kinematics.hpp gives their ends), or a constant inertia at the joints, and of
// the hand's mass. The motion is integrated by Gauss's collocation of order 4 (gauss.hpp), its stages solved to
// rounding; the actuators are exact (drives.hpp). Each joint either slides or is stuck, with a velocity of exactly
// zero; every change between the two is located within a step and ends it. Over steps h the motion and the ledger's
// imbalance are wrong by O(h⁴): M turns with the arm, and then no collocation keeps the kinetic energy to rounding.
// Where the joints' motion is prescribed, the hand does what that takes.
#pragma once

#include <vector>

#include <dashpot/arm_device.hpp>
#include <dashpot/arm_kinematics.hpp>
#include <dashpot/simulated/arm_scenario.hpp>
#include <dashpot/simulated/drives.hpp>
#include <dashpot/simulated/energy_ledger.hpp>
#include <dashpot/simulated/shaft_sensors.hpp>

namespace dashpot::simulated {

// All that acts on the arm at one instant.
struct arm_view {
  double time = 0;                             // [s]
  double position[arm_axes] = {};              // of the joints [rad] or [m]
  double velocity[arm_axes] = {};              // [rad/s] or [m/s]; exactly 0 while stuck
  double motor_torque[arm_axes] = {};          // behind the amplifiers, along +q
  double brake_damping[most_arm_brakes] = {};  // true, with gain, residual and speed
  double tip_position[2] = {};                 // [m]
  double tip_velocity[2] = {};                 // [m/s]
  bool stuck[arm_axes] = {};
};

// What motors and brakes oppose to a joint's motion [N·m] or [N].
inline double opposed_by_actuators(const arm_description& arm, const arm_view& view, unsigned joint) noexcept {
  double torque = -view.motor_torque[joint];
  for (unsigned i = 0; i < arm.brake_count; ++i) {
    const double(&along)[arm_axes] = arm.brakes[i].along;
    const double rate = along[0] * view.velocity[0] + along[1] * view.velocity[1];
    torque += along[joint] * view.brake_damping[i] * rate;
  }
  return torque;
}

class arm_plant {
 public:
  arm_plant(const arm_description& arm, const arm_scenario& scene);

  // As plant::advance(); `sensors` of each joint.
  void advance(double duration, double end, const arm_actuation& demand, shaft_sensors (&sensors)[arm_axes]) noexcept;

  // A disturbance of a motor, in addition to its command, until the next call [N·m] or [N].
  void disturb(unsigned joint, double torque) noexcept { motors_[joint].disturb(torque); }

  shaft_motion shaft(unsigned joint) const noexcept { return {time_, now_.q[joint], now_.v[joint]}; }
  const energy_ledger& ledger() const noexcept { return ledger_; }
  arm_view view() const noexcept;
  arm_view view_under(const arm_actuation& demand) const noexcept;  // as if that took effect now

 private:
  struct state {
    double q[arm_axes];  // [rad] or [m]
    double v[arm_axes];  // [rad/s] or [m/s]
  };
  // At one instant, with the accelerations that they make.
  struct forces {
    double acceleration[arm_axes];
    double hold[arm_axes];  // on a stuck joint: what keeps it there [N·m] or [N]
    energy_ledger power;    // [W]; of `kinetic` nothing
  };
  struct step {
    state end;
    energy_ledger work;
  };
  // What actuators do at a time within the coming step, whatever the motion.
  struct drive {
    double torque[arm_axes];          // [N·m] or [N]
    double damping[most_arm_brakes];  // at no speed [N·m·s/rad] or [N·s/m]
  };

  step attempt(double duration) const noexcept;
  step follow(double duration) const noexcept;
  state prescribed_at(double time) const noexcept;
  forces balance(double ahead, const state& at, const drive& driven) const noexcept;
  drive drive_after(double ahead) const noexcept;
  bool is_stuck(unsigned joint) const noexcept;
  double friction(unsigned joint) const noexcept { return arm_.joints[joint].mechanics.coulomb_friction; }
  bool violates(const step& candidate, double duration, bool (&joints)[arm_axes]) const noexcept;
  bool is_consistent(const bool (&rests)[arm_axes]) const noexcept;
  void integrate(double duration, shaft_sensors (&sensors)[arm_axes]) noexcept;
  void commit(const step& done, double duration, shaft_sensors (&sensors)[arm_axes]) noexcept;
  void settle() noexcept;
  bool holds_hand(double ahead) const noexcept { return time_ + ahead < user_.release_time; }
  double kinetic(const state& at) const noexcept;
  double longest_step() const noexcept;

  arm_description arm_;
  planar_hand user_;
  tip_path intended_;
  joints_path prescribed_;
  std::vector<drives> motors_;
  std::vector<drives> brakes_;
  double stated_step_;  // [s]; 0: to be chosen
  double period_;       // [s]

  double time_ = 0;  // [s]
  state now_;
  double direction_[arm_axes] = {};  // of sliding: +1 or −1; 0: stuck
  double kinetic_at_start_ = 0;
  energy_ledger ledger_;
};

}  // namespace dashpot::simulated
