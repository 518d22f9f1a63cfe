// Simulates motor, brake and encoder for a board that has none: a handle on a rail, moved by a hand along a given path.
// Deterministic, in single precision, alike to the last bit on every processor that is told not to fuse operations.
//
//     m v̇ = F_motor + k (q_wanted(t) − q) − (b_hand + b_brake) v,    q̇ = v        (implicit in the dampers)
//
// q_wanted rises and falls by 20 mm in a triangle of 1,024 steps, whatever a step lasts.
#pragma once

#include <cstdint>

#include <dashpot/board/supervisor.hpp>

namespace dashpot::board {

// Of an encoder that rounds down.
inline std::int32_t counts_at(float position, float step) noexcept {
  const float steps = position / step;
  const auto towards_zero = static_cast<std::int32_t>(steps);
  return static_cast<float>(towards_zero) > steps ? towards_zero - 1 : towards_zero;
}

// Rises from 0 to 1 in `rise` steps, falls in as many, and so on.
inline float triangle(std::uint32_t step, std::uint32_t rise) noexcept {
  const std::uint32_t phase = step % (2 * rise);
  return static_cast<float>(phase < rise ? phase : 2 * rise - phase) / static_cast<float>(rise);
}

class test_plant {
 public:
  static constexpr unsigned axes = 1, brakes = 1;
  static constexpr double encoder_step = 1e-5;  // [m] a count, rounded down

  // One step of `period` [s] under these outputs.
  void advance(const outputs& applied, float period) noexcept {
    ++steps_;
    const float gain = period / mass;
    const float pull = applied.motor_torque + hand_stiffness * (wanted() - position_);
    velocity_ = (velocity_ + gain * pull) / (1.0F + gain * (hand_damping + applied.brake_damping));
    position_ += period * velocity_;
  }

  std::int32_t counts(unsigned = 0) const noexcept { return counts_at(position_, static_cast<float>(encoder_step)); }

 private:
  static constexpr float mass = 0.1F;              // [kg]
  static constexpr float hand_stiffness = 150.0F;  // [N/m]
  static constexpr float hand_damping = 3.0F;      // [N·s/m]
  static constexpr float amplitude = 0.02F;        // [m]

  float wanted() const noexcept { return amplitude * triangle(steps_, 512); }

  std::uint32_t steps_ = 0;
  float position_ = 0;  // [m]
  float velocity_ = 0;  // [m/s]
};

}  // namespace dashpot::board
