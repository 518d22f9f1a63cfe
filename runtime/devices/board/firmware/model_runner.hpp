// Runs an emitted update law on the board: encoder counts in, motor torque and brake damping at the joint out.
//
// The velocity is the backward difference of one sample. A model of a translational network acts at the tool, `arm_radius`
// [m] away from a rotary joint; 1 where the network acts on the joint coordinate itself.
#pragma once

#include <cstdint>

#include <dashpot/board/supervisor.hpp>

namespace dashpot::board {

// What a firmware without a model has in its place.
struct no_model {};

struct model_answer {
  outputs wish;
  float speed = 0;  // of the joint [rad/s] or [m/s]
};

template <class Model>
class model_runner {
 public:
  static constexpr auto period = static_cast<std::uint32_t>(static_cast<double>(Model::sample_period) * 1e9 + 0.5);  // [ns]

  // `encoder_step` [rad] or [m] a count.
  constexpr model_runner(float encoder_step, float arm_radius) noexcept
      : encoder_step_(encoder_step), arm_radius_(arm_radius) {}

  // The next step begins at rest, wherever it is.
  void restart() noexcept { begun_ = false; }

  model_answer step(std::int32_t counts) noexcept {
    if (!begun_) begin(counts);
    const auto moved = static_cast<std::int32_t>(static_cast<std::uint32_t>(counts) - static_cast<std::uint32_t>(counts_));
    counts_ = counts;
    const float speed = static_cast<float>(moved) * encoder_step_ / static_cast<float>(Model::sample_period);
    const auto command = model_.step(at_tool(counts), scalar(speed * arm_radius_));
    const float torque = -static_cast<float>(command.force) * arm_radius_;
    const float damping = static_cast<float>(command.damping) * arm_radius_ * arm_radius_;
    return {{torque, damping}, speed};
  }

 private:
  using scalar = typename Model::scalar;

  void begin(std::int32_t counts) noexcept {
    counts_ = counts;
    model_.reset(at_tool(counts));
    begun_ = true;
  }

  scalar at_tool(std::int32_t counts) const noexcept {
    return scalar(static_cast<float>(counts) * encoder_step_ * arm_radius_);
  }

  Model model_;
  float encoder_step_;
  float arm_radius_;
  std::int32_t counts_ = 0;
  bool begun_ = false;
};

template <>
class model_runner<no_model> {
 public:
  static constexpr std::uint32_t period = 0;
  constexpr model_runner(float, float) noexcept {}
  void restart() noexcept {}
  model_answer step(std::int32_t) noexcept { return {}; }
};

}  // namespace dashpot::board
