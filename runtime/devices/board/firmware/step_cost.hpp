// What one step of a model costs on this processor.
#pragma once

#include <cstdint>

#include "application.hpp"

namespace dashpot::board {

// Out of line, so that nothing is known of the numbers and the states stay in memory, as they do from sample to sample.
template <class Model, class Scalar>
[[gnu::noinline]] auto one_step(Model& model, Scalar position, Scalar velocity) noexcept {
  return model.step(position, velocity);
}

// What the call and the loop around it cost by themselves.
template <class Scalar>
struct idle_step {
  command<Scalar> step(Scalar position, Scalar velocity) noexcept { return {position, velocity}; }
};

// Forth and back, so that forces of both signs come.
template <class Model, class Scalar, class Clock>
std::uint32_t ticks_of(Model& model, std::uint32_t calls, Scalar position, Clock&& clock) noexcept {
  [[maybe_unused]] volatile Scalar force = 0;  // volatile: steps that nobody needs would not be run
  const std::uint32_t start = clock();
  for (std::uint32_t i = 0; i < calls; ++i) {
    position = -position;
    force = one_step(model, position, position).force;
  }
  return clock() - start;
}

// The same of two axes: the joints swing about where a pantograph holds its tip before it.
template <class Model, class Scalar>
[[gnu::noinline]] auto one_arm_step(Model& model, const Scalar (&position)[arm_axes],
                                    const Scalar (&velocity)[arm_axes]) noexcept {
  return model.step(position, velocity);
}

template <class Model>
struct idle_arm_step {
  using scalar = typename Model::scalar;
  commands<scalar, Model::axes, Model::brakes> step(const scalar (&position)[arm_axes],
                                                    const scalar (&velocity)[arm_axes]) noexcept {
    return {{}, {position[0], velocity[1]}};
  }
};

template <class Model, class Scalar, class Clock>
std::uint32_t ticks_of_arm(Model& model, std::uint32_t calls, Scalar swing, Clock&& clock) noexcept {
  [[maybe_unused]] volatile Scalar torque = 0;
  const std::uint32_t start = clock();
  for (std::uint32_t i = 0; i < calls; ++i) {
    swing = -swing;
    const Scalar position[arm_axes] = {swing + Scalar(2.3), swing + Scalar(0.8)}, velocity[arm_axes] = {swing, swing};
    torque = one_arm_step(model, position, velocity).torque[0];
  }
  return clock() - start;
}

// Runs `calls` steps of a model of its own between two readings of `clock()`, whose ticks count up, and takes off the
// same loop around a step that does nothing.
template <class Model, class Clock>
model_cost measure_steps(std::uint32_t calls, Clock&& clock) noexcept {
  using scalar = typename Model::scalar;
  constexpr auto position = static_cast<scalar>(0.001);
  Model model;
  if constexpr (has_two_axes<Model>) {
    model.reset({scalar(2.3), scalar(0.8)});
    idle_arm_step<Model> idle;
    return {ticks_of_arm(model, calls, position, clock) - ticks_of_arm(idle, calls, position, clock), calls};
  } else {
    model.reset(0);
    idle_step<scalar> idle;
    return {ticks_of(model, calls, position, clock) - ticks_of(idle, calls, position, clock), calls};
  }
}

}  // namespace dashpot::board
