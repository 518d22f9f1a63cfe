// The motors, brakes and encoders of a board of two axes that has none: two joints of a pantograph with one inertia
// matrix wherever they are, moved by a hand. Deterministic as test_plant.hpp.
//
//     M v̇ = τ + k (q_wanted(t) − q) − (b_hand + D_brakes) v,    q̇ = v        (implicit in the dampers)
//
// Each q_wanted swings by ± 0.05 rad about its middle, in a triangle; the two differ in their periods.
#pragma once

#include <cstdint>

#include <dashpot/board/supervisor.hpp>

#include "test_plant.hpp"

namespace dashpot::board {

class test_arm {
 public:
  static constexpr unsigned axes = arm_axes, brakes = 2;
  static constexpr double encoder_step = 2 * 3.14159265358979323846 / 65536;  // [rad] a count, rounded down
  static constexpr float middle[axes] = {2.3378F, 0.8038F};                   // [rad]

  // One step of `period` [s] under these outputs. The brakes are along the joints, the first two of them.
  void advance(const arm_outputs& applied, float period) noexcept {
    ++steps_;
    float drive[axes], own[axes];  // (M + h D) v⁺ = drive; M + h D has `own` on its diagonal
    for (unsigned j = 0; j < axes; ++j) {
      const float momentum = inertia * velocity_[j] + coupling * velocity_[1 - j];
      const float pull = applied.motor_torque[j] + hand_stiffness * (wanted(j) - position_[j]);
      drive[j] = momentum + period * pull;
      own[j] = inertia + period * (hand_damping + applied.brake_damping[j]);
    }
    const float determinant = own[0] * own[1] - coupling * coupling;
    for (unsigned j = 0; j < axes; ++j) {
      velocity_[j] = (own[1 - j] * drive[j] - coupling * drive[1 - j]) / determinant;
      position_[j] += period * velocity_[j];
    }
  }

  std::int32_t counts(unsigned joint) const noexcept {
    return counts_at(position_[joint], static_cast<float>(encoder_step));
  }

 private:
  static constexpr float inertia = 2e-4F;        // [kg·m²]
  static constexpr float coupling = 3e-5F;       // off the diagonal of M [kg·m²]
  static constexpr float hand_stiffness = 0.6F;  // [N·m/rad]
  static constexpr float hand_damping = 0.01F;   // [N·m·s/rad]
  static constexpr float amplitude = 0.05F;      // [rad]
  static constexpr std::uint32_t rise[axes] = {512, 352};

  // It begins in the middle, on its way up.
  float wanted(unsigned joint) const noexcept {
    return middle[joint] + amplitude * (2 * triangle(steps_ + rise[joint] / 2, rise[joint]) - 1);
  }

  std::uint32_t steps_ = 0;
  float position_[axes] = {middle[0], middle[1]};  // [rad]
  float velocity_[axes] = {};                      // [rad/s]
};

}  // namespace dashpot::board
