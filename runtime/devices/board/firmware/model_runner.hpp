// Runs an emitted update law on the board: encoder readings in, motor torques and brake dampings at the joints out.
//
// The velocities come from the estimators that the description asks for, and a model has to be certified for them. A
// model of a translational network acts at the tool, `arm_radius` [m] away from a rotary joint; 1 where it acts on the
// joint coordinate itself, as every model of two axes does.
//
// A counter may wrap around: it is followed over its ends. Position 0 is where the counter stands at 0, as for a host;
// but where a run begins beyond ± farthest_zero of that, single precision would no longer tell neighbouring counts
// apart, and position 0 is where the run begins: a wheel that turns without end has no other zero.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include <dashpot/arm_model.hpp>
#include <dashpot/board/supervisor.hpp>
#include <dashpot/board/wide_counter.hpp>
#include <dashpot/estimators/any_estimator.hpp>

#include "encoder_reading.hpp"

namespace dashpot::board {

// Stands in for the model in a firmware without one.
struct no_model {};

template <class Model>
inline constexpr unsigned axes_of = has_two_axes<Model> ? arm_axes : 1;

// The number of brakes that a model commands.
template <class Model>
constexpr unsigned brakes_that_drive() noexcept {
  if constexpr (has_two_axes<Model>) return static_cast<unsigned>(Model::brakes);
  else return 1;
}

// Whether a model may run on this estimator of that joint: compiled for it, or for the ideal device.
template <class Model>
constexpr bool is_certified_for(estimator_kind estimator, unsigned joint = 0) noexcept {
  if (Model::certified_for::any_device) return true;
  const char* wanted = nth(Model::certified_for::estimator, joint);
  const char* given = name_of(estimator);
  while (*wanted != 0 && *wanted == *given) ++wanted, ++given;
  return *wanted == *given;
}

// By how much the counters have moved.
template <unsigned Axes>
struct basic_move {
  one_each<std::int32_t, Axes> counts = {};
};

template <unsigned Axes>
struct basic_model_answer {
  basic_outputs<Axes> wish;
  one_each<float, Axes> speed = {};  // of the joint [rad/s] or [m/s]
};
using model_answer = basic_model_answer<1>;

// One encoder, as the model sees it.
class followed_joint {
 public:
  static constexpr std::int64_t farthest_zero = 1 << 22;  // counts; a quarter of what is exact in single precision

  // `encoder_step` [rad] or [m] a count.
  constexpr followed_joint(double encoder_step, const velocity_description& velocity, double sample_period) noexcept
      : estimator_(velocity, sample_period, encoder_step), encoder_step_(static_cast<float>(encoder_step)) {}

  std::int32_t follow(std::int32_t counts) noexcept { return counter_.follow(counts); }
  void forget() noexcept { counter_.restart(); }

  void begin() noexcept {
    origin_ = counter_.value();
    zero_ = origin_ > farthest_zero || origin_ < -farthest_zero ? origin_ : 0;
    estimator_.reset(0);
  }

  float position() const noexcept { return moved_from(zero_) * encoder_step_; }

  // From where the run began: there single precision is finest.
  float estimate(std::uint64_t timestamp, std::uint64_t edge_time) noexcept {
    device_sample sample;
    sample.position = static_cast<double>(moved_from(origin_) * encoder_step_);
    sample.timestamp_ns = timestamp;
    sample.edge_time_ns = edge_time;
    return estimator_.update(sample);
  }

 private:
  // Whole counts are subtracted as such: rounded first, the difference of two large ones would be lost.
  float moved_from(std::int64_t place) const noexcept { return static_cast<float>(counter_.value() - place); }

  any_estimator<float> estimator_;
  float encoder_step_;
  wide_counter counter_;
  std::int64_t origin_ = 0;  // where the run began [counts]
  std::int64_t zero_ = 0;    // where the model's position is 0 [counts]
};

template <class Model, unsigned Axes = axes_of<Model>>
class model_runner {
  static_assert(Axes == axes_of<Model>, "a model of two axes runs on a board of two axes, one of one on one of one");
  using reading = basic_encoder_reading<Axes>;
  using scalar = typename Model::scalar;
  using scalars = one_each<scalar, Axes>;

 public:
  static constexpr auto period =
      static_cast<std::uint32_t>(static_cast<double>(Model::sample_period) * 1e9 + 0.5);  // [ns]

  // `encoder_step` [rad] or [m] a count.
  constexpr model_runner(const one_each<double, Axes>& encoder_step,
                         const one_each<velocity_description, Axes>& velocity, float arm_radius) noexcept
      : model_runner(encoder_step, velocity, arm_radius, std::make_index_sequence<Axes>()) {}

  // The next step begins at rest, wherever it is.
  void restart() noexcept { begun_ = false; }

  // The next reading has no predecessor.
  void forget() noexcept {
    for (followed_joint& joint : joints_) joint.forget();
    begun_ = false;
  }

  // Every reading, whether or not a step follows it. Returns by how much the counters have moved since the one before;
  // 0 before the first step of a run, which may begin anywhere.
  basic_move<Axes> watch(const reading& now) noexcept {
    basic_move<Axes> moved;
    for (unsigned j = 0; j < Axes; ++j) {
      const std::int32_t counts = joints_[j].follow(nth(now.counts, j));
      nth(moved.counts, j) = begun_ ? counts : 0;
    }
    return moved;
  }

  basic_model_answer<Axes> step(const reading& now) noexcept {
    watch(now);
    if (!begun_) begin();
    basic_model_answer<Axes> answer;
    scalars position = {}, velocity = {};
    for (unsigned j = 0; j < Axes; ++j) {
      const float speed = joints_[j].estimate(now.timestamp, nth(now.edge_time, j));
      nth(position, j) = scalar(joints_[j].position() * arm_radius_);
      nth(velocity, j) = scalar(speed * arm_radius_);
      nth(answer.speed, j) = speed;
    }
    take(model_.step(position, velocity), answer.wish);
    return answer;
  }

 private:
  template <std::size_t... Joint>
  constexpr model_runner(const one_each<double, Axes>& encoder_step,
                         const one_each<velocity_description, Axes>& velocity, float arm_radius,
                         std::index_sequence<Joint...>) noexcept
      : joints_{{nth(encoder_step, Joint), nth(velocity, Joint), whole_period}...}, arm_radius_(arm_radius) {}

  void begin() noexcept {
    scalars position = {};
    for (unsigned j = 0; j < Axes; ++j) {
      joints_[j].begin();
      nth(position, j) = scalar(joints_[j].position() * arm_radius_);
    }
    model_.reset(position);
    begun_ = true;
  }

  void take(const command<scalar>& wanted, outputs& wish) const noexcept {
    wish.motor_torque = -static_cast<float>(wanted.force) * arm_radius_;
    wish.brake_damping = static_cast<float>(wanted.damping) * arm_radius_ * arm_radius_;
  }
  template <int ModelBrakes>
  static void take(const commands<scalar, arm_axes, ModelBrakes>& wanted, arm_outputs& wish) noexcept {
    for (unsigned j = 0; j < arm_axes; ++j) wish.motor_torque[j] = -static_cast<float>(wanted.torque[j]);
    for (int i = 0; i < ModelBrakes; ++i) wish.brake_damping[i] = static_cast<float>(wanted.damping[i]);
  }

  static constexpr double whole_period = period / 1e9;  // whole nanoseconds: a float's 0.001 is not 0.001

  Model model_;
  followed_joint joints_[Axes];
  float arm_radius_;
  bool begun_ = false;
};

template <unsigned Axes>
class model_runner<no_model, Axes> {
 public:
  static constexpr std::uint32_t period = 0;
  constexpr model_runner(const one_each<double, Axes>&, const one_each<velocity_description, Axes>&, float) noexcept {}
  void restart() noexcept {}
  void forget() noexcept {}
  basic_move<Axes> watch(const basic_encoder_reading<Axes>&) noexcept { return {}; }
  basic_model_answer<Axes> step(const basic_encoder_reading<Axes>&) noexcept { return {}; }
};

}  // namespace dashpot::board
