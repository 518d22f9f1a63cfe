// Runs an emitted update law on the board: encoder readings in, motor torque and brake damping at the joint out.
//
// The velocity comes from the estimator that the description asks for, and a model has to be certified for it. A model
// of a translational network acts at the tool, `arm_radius` [m] away from a rotary joint; 1 where it acts on the joint
// coordinate itself.
//
// The counter may wrap around: it is followed over its ends. Position 0 is where the counter stands at 0, as for a
// host; but where a run begins beyond ± farthest_zero of that, single precision would no longer tell neighbouring
// counts apart, and position 0 is where the run begins: a wheel that turns without end has no other zero.
#pragma once

#include <cstdint>

#include <dashpot/board/supervisor.hpp>
#include <dashpot/board/wide_counter.hpp>
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
  static constexpr std::int64_t farthest_zero = 1 << 22;  // counts; a quarter of what is exact in single precision
  static constexpr auto period =
      static_cast<std::uint32_t>(static_cast<double>(Model::sample_period) * 1e9 + 0.5);  // [ns]

  // `encoder_step` [rad] or [m] a count.
  constexpr model_runner(double encoder_step, const velocity_description& velocity, float arm_radius) noexcept
      : estimator_(velocity, period / 1e9, encoder_step),  // whole nanoseconds: a float's 0.001 is not 0.001
        encoder_step_(static_cast<float>(encoder_step)),
        arm_radius_(arm_radius) {}

  // The next step begins at rest, wherever it is.
  void restart() noexcept { begun_ = false; }

  // The next reading has no predecessor.
  void forget() noexcept {
    counter_.restart();
    begun_ = false;
  }

  // Every reading, whether or not a step follows it. Returns by how much the counter has moved since the one before; 0
  // before the first step of a run, which may begin anywhere.
  std::int32_t watch(const encoder_reading& reading) noexcept {
    const std::int32_t moved = counter_.follow(reading.counts);
    return begun_ ? moved : 0;
  }

  model_answer step(const encoder_reading& reading) noexcept {
    watch(reading);
    if (!begun_) begin();
    const float tool_position = moved_from(zero_) * encoder_step_ * arm_radius_;
    const float speed = estimate(reading);
    const auto command = model_.step(scalar(tool_position), scalar(speed * arm_radius_));
    const float torque = -static_cast<float>(command.force) * arm_radius_;
    const float damping = static_cast<float>(command.damping) * arm_radius_ * arm_radius_;
    return {{torque, damping}, speed};
  }

 private:
  using scalar = typename Model::scalar;

  void begin() noexcept {
    origin_ = counter_.value();
    zero_ = origin_ > farthest_zero || origin_ < -farthest_zero ? origin_ : 0;
    estimator_.reset(0);
    model_.reset(scalar(moved_from(zero_) * encoder_step_ * arm_radius_));
    begun_ = true;
  }

  // Whole counts are subtracted as such: rounded first, the difference of two large ones would be lost.
  float moved_from(std::int64_t place) const noexcept { return static_cast<float>(counter_.value() - place); }

  // From where the run began: there single precision is finest.
  float estimate(const encoder_reading& reading) noexcept {
    device_sample sample;
    sample.position = static_cast<double>(moved_from(origin_) * encoder_step_);
    sample.timestamp_ns = reading.timestamp;
    sample.edge_time_ns = reading.edge_time;
    return estimator_.update(sample);
  }

  Model model_;
  any_estimator<float> estimator_;
  float encoder_step_;
  float arm_radius_;
  wide_counter counter_;
  std::int64_t origin_ = 0;  // where the run began [counts]
  std::int64_t zero_ = 0;    // where the model's position is 0 [counts]
  bool begun_ = false;
};

template <>
class model_runner<no_model> {
 public:
  static constexpr std::uint32_t period = 0;
  constexpr model_runner(double, const velocity_description&, float) noexcept {}
  void restart() noexcept {}
  void forget() noexcept {}
  std::int32_t watch(const encoder_reading&) noexcept { return 0; }
  model_answer step(const encoder_reading&) noexcept { return {}; }
};

}  // namespace dashpot::board
