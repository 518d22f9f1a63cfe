// An update law in the shape of emitted code, for tests that are not about the compiler: the general viscoelastic solid
// of Gosline & Hayward 2009, Fig. 5, in single precision. K1 = 12 and B1 = 5 in series, K2 = 10 and B2 = 6 in series,
// both beside K3 = 5 [N/m, N·s/m]; exact scheme at 1 kHz, states driven by velocity, most dissipative: b = B1 + B2.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class stand_in_model {
 public:
  using scalar = float;
  static constexpr scalar sample_period = 0.001F;  // [s]
  static constexpr dashpot::motion port_motion = dashpot::motion::translation;
  struct certified_for {
    static constexpr bool any_device = true;
    static constexpr const char* device = "";
    static constexpr const char* device_digest = "";
    static constexpr const char* estimator = "backward_difference";
    static constexpr unsigned loop_delay = 0;
  };

  void reset(scalar position = 0) noexcept {
    B1_K1_force_ = 0;
    B2_K2_force_ = 0;
    history_ = 0;
    sampled_ = false;
    K3_force_ = K3 * position;
  }

  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    if (!dashpot::all_finite(position, velocity, scalar(0))) return {damping, 0};
    sampled_ = true;
    displacement_ = sample_period * velocity;
    K3_force_ = K3 * position;
    return {damping, K3_force_ + input_gain * displacement_ + history_ - damping * velocity};
  }

  void update() noexcept {
    if (!sampled_) return;
    B1_K1_force_ += B1_K1_gain * displacement_ - B1_K1_decay * B1_K1_force_;
    B2_K2_force_ += B2_K2_gain * displacement_ - B2_K2_decay * B2_K2_force_;
    history_ = (B1_K1_force_ - B1_K1_decay * B1_K1_force_) + (B2_K2_force_ - B2_K2_decay * B2_K2_force_);
    sampled_ = false;
  }

  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    const dashpot::command<scalar> now = output(position, velocity);
    update();
    return now;
  }

  scalar stored_energy() const noexcept {
    return K3_force_ * K3_force_ / (2 * K3) + B1_K1_force_ * B1_K1_force_ / (2 * K1) +
           B2_K2_force_ * B2_K2_force_ / (2 * K2);
  }

 private:
  static constexpr scalar K1 = 12, K2 = 10, K3 = 5;      // [N/m]
  static constexpr scalar damping = 11;                  // B1 + B2 [N·s/m]
  static constexpr scalar B1_K1_decay = 0.00239712230F;  // 1 − exp(−λh), λ = 12/5
  static constexpr scalar B1_K1_gain = 11.9856115F;      // K1 (1 − exp(−λh))/(λh) [N/m]
  static constexpr scalar B2_K2_decay = 0.00166527855F;  // λ = 10/6
  static constexpr scalar B2_K2_gain = 9.99167129F;      // [N/m]
  static constexpr scalar input_gain = B1_K1_gain + B2_K2_gain;

  scalar B1_K1_force_ = 0;   // [N]
  scalar B2_K2_force_ = 0;   // [N]
  scalar K3_force_ = 0;      // [N]
  scalar history_ = 0;       // what is left of the branch forces one sample later [N]
  scalar displacement_ = 0;  // of this sample [m]
  bool sampled_ = false;     // output() took one that update() has not seen
};

}  // namespace dashpot::generated
