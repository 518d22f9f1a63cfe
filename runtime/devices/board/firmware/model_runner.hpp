// Runs an emitted update law on the board: encoder readings in, motor torque and brake damping at the joint out.
//
// The velocity comes from the estimator that the description asks for, and a model has to be certified for it. A model
// of a translational network acts at the tool, `arm_radius` [m] away from a rotary joint; 1 where it acts on the joint
// coordinate itself.
#pragma once

#include <cstdint>

#include <dashpot/board/supervisor.hpp>
#include <dashpot/estimators/any_estimator.hpp>

#include "encoder_reading.hpp"

namespace dashpot::board {

// What a firmware without a model has in its place.
struct no_model {};

// Whether a model may run on this estimator: compiled for it, or for the ideal device.
template <class Model>
constexpr bool is_certified_for(estimator_kind estimator) noexcept {
  if (Model::certified_for::any_device) return true;
  const char* wanted = Model::certified_for::estimator;
  const char* given = name_of(estimator);
  while (*wanted != 0 && *wanted == *given) ++wanted, ++given;
  return *wanted == *given;
}

struct model_answer {
  outputs wish;
  float speed = 0;  // of the joint [rad/s] or [m/s]
};

template <class Model>
class model_runner {
 public:
  static constexpr auto period =
      static_cast<std::uint32_t>(static_cast<double>(Model::sample_period) * 1e9 + 0.5);  // [ns]

  // `encoder_step` [rad] or [m] a count.
  constexpr model_runner(double encoder_step, const velocity_description& velocity, float arm_radius) noexcept
      : estimator_(velocity, period / 1e9, encoder_step),  // whole nanoseconds: a float's 0.001 is not 0.001
        encoder_step_(static_cast<float>(encoder_step)),
        arm_radius_(arm_radius) {}

  // The next step begins at rest, wherever it is.
  void restart() noexcept { begun_ = false; }

  model_answer step(const encoder_reading& reading) noexcept {
    const float tool_position = static_cast<float>(reading.counts) * encoder_step_ * arm_radius_;
    if (!begun_) begin(reading.counts, tool_position);
    const float speed = estimate(reading);
    const auto command = model_.step(scalar(tool_position), scalar(speed * arm_radius_));
    const float torque = -static_cast<float>(command.force) * arm_radius_;
    const float damping = static_cast<float>(command.damping) * arm_radius_ * arm_radius_;
    return {{torque, damping}, speed};
  }

 private:
  using scalar = typename Model::scalar;

  void begin(std::int32_t counts, float tool_position) noexcept {
    origin_ = static_cast<std::uint32_t>(counts);
    estimator_.reset(0);
    model_.reset(scalar(tool_position));
    begun_ = true;
  }

  // From where the run began: there single precision is finest, and the counter may wrap around on the way.
  float estimate(const encoder_reading& reading) noexcept {
    const auto moved = static_cast<std::int32_t>(static_cast<std::uint32_t>(reading.counts) - origin_);
    device_sample sample;
    sample.position = static_cast<double>(static_cast<float>(moved) * encoder_step_);
    sample.timestamp_ns = reading.timestamp;
    sample.edge_time_ns = reading.edge_time;
    return estimator_.update(sample);
  }

  Model model_;
  any_estimator<float> estimator_;
  float encoder_step_;
  float arm_radius_;
  std::uint32_t origin_ = 0;  // counts
  bool begun_ = false;
};

template <>
class model_runner<no_model> {
 public:
  static constexpr std::uint32_t period = 0;
  constexpr model_runner(double, const velocity_description&, float) noexcept {}
  void restart() noexcept {}
  model_answer step(const encoder_reading&) noexcept { return {}; }
};

}  // namespace dashpot::board
