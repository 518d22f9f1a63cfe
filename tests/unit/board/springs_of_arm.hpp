// A law of two axes in the shape of emitted code, for tests that are not about the compiler.
#pragma once

#include <dashpot/command.hpp>

#include "test_arm.hpp"

namespace dashpot::board {

// Two springs that are relaxed at the middle of the test arm, and a third between the joints.
template <class Scalar>
struct springs_of_arm {
  using scalar = Scalar;
  static constexpr int axes = 2, brakes = 2;
  static constexpr scalar sample_period = scalar(0.001);
  static constexpr dashpot::motion port_motion = dashpot::motion::rotation;
  struct certified_for {
    static constexpr bool any_device = true;
    static constexpr const char* device = "";
    static constexpr const char* device_digest = "";
    static constexpr const char* estimator[axes] = {"backward_difference", "backward_difference"};
    static constexpr unsigned loop_delay = 0;
  };

  void reset(const scalar (&position)[axes]) noexcept { place(position); }
  commands<scalar, axes, brakes> output(const scalar (&position)[axes], const scalar (&velocity)[axes]) noexcept {
    place(position);
    const scalar between = scalar(0.1) * (off_[0] - off_[1]);
    return {{scalar(0.01), scalar(0.02)},
            {scalar(0.5) * off_[0] + between + scalar(1e-3) * velocity[1], scalar(1.5) * off_[1] - between}};
  }
  void update() noexcept {}
  commands<scalar, axes, brakes> step(const scalar (&position)[axes], const scalar (&velocity)[axes]) noexcept {
    return output(position, velocity);
  }
  scalar stored_energy() const noexcept { return 0; }

 private:
  void place(const scalar (&position)[axes]) noexcept {
    for (unsigned j = 0; j < 2; ++j) off_[j] = position[j] - scalar(test_arm::middle[j]);
  }

  scalar off_[axes] = {};  // [rad]
};

}  // namespace dashpot::board
