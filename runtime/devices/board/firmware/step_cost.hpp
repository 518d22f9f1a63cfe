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

// Runs `calls` steps of a model of its own between two readings of `clock()`, whose ticks count up, and takes off the
// same loop around a step that does nothing.
template <class Model, class Clock>
model_cost measure_steps(std::uint32_t calls, Clock&& clock) noexcept {
  constexpr auto position = static_cast<typename Model::scalar>(0.001);
  Model model;
  model.reset(0);
  idle_step<typename Model::scalar> idle;
  return {ticks_of(model, calls, position, clock) - ticks_of(idle, calls, position, clock), calls};
}

}  // namespace dashpot::board
