// Stands in for the emitted header of architecture, section 5: Fig. 5's network of the paper, K1 = 12, B1 = 5, K2 = 10,
// B2 = 6, K3 = 5, exact scheme at 1 kHz, most-dissipative (b = B1 + B2), velocity driven, for the ideal device.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class second_order_maxwell {
 public:
  using scalar = double;
  static constexpr scalar sample_period = 0.001;  // [s]
  static constexpr dashpot::motion port_motion = dashpot::motion::translation;
  struct certified_for {
    static constexpr bool any_device = true;
    static constexpr const char* device = "";
    static constexpr const char* device_digest = "";
    static constexpr const char* estimator = "";
    static constexpr unsigned loop_delay = 0;
  };
  struct parameters {};

  void reset(scalar position = 0) noexcept {
    position_ = position;
    B1_K1_force_ = B2_K2_force_ = 0;
    last_ = {damping_, K3 * position};
  }

  // m = K3 u + Σ F + (0 − b) v̂, the forces F at this sample
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    if (!all_finite(position, velocity, scalar(0))) return {last_.damping, 0};
    position_ = position;
    velocity_ = velocity;
    last_ = {damping_, K3 * position + B1_K1() + B2_K2() - damping_ * velocity};
    return last_;
  }

  // F ← a F + c h v̂
  void update() noexcept {
    B1_K1_force_ = B1_K1();
    B2_K2_force_ = B2_K2();
  }

  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    const dashpot::command<scalar> result = output(position, velocity);
    update();
    return result;
  }

  unsigned set(const parameters&) noexcept { return 0; }

  scalar stored_energy() const noexcept {
    return (K3 * position_ * position_ + B1_K1_force_ * B1_K1_force_ / 12.0 + B2_K2_force_ * B2_K2_force_ / 10.0) / 2;
  }

 private:
  static constexpr scalar K3 = 5.0;         // [N/m]
  static constexpr scalar damping_ = 11.0;  // b [N·s/m]

  // a = e^(−λh), λ = 2.4 1/s and 5/3 1/s; c h = B (1 − a)
  scalar B1_K1() const noexcept { return 0.9976028776973818 * B1_K1_force_ + 0.011985611513091316 * velocity_; }
  scalar B2_K2() const noexcept { return 0.9983347214509387 * B2_K2_force_ + 0.009991671294367926 * velocity_; }

  scalar position_ = 0;     // [m]
  scalar velocity_ = 0;     // [m/s]
  scalar B1_K1_force_ = 0;  // [N]
  scalar B2_K2_force_ = 0;  // [N]
  dashpot::command<scalar> last_{damping_, 0};
};

}  // namespace dashpot::generated
