// Long runs of a law, shared by the timer and by the counter of instructions.
#pragma once

namespace dashpot::benchmarks {

// Each step waits for the force of the step before: the time of a step by itself.
template <class Law>
double run_chain(Law& law, long steps) {
  double position = 0.01, force = 0;
  for (long i = 0; i < steps; ++i) {
    force = law.step(position, 0.5).force;
    position = 0.01 + 1e-9 * force;
  }
  return force;
}

// Inputs are there beforehand: the time of a step among many, as far as its states allow.
template <class Law>
double run_stream(Law& law, long steps) {
  double sum = 0, position = 0.01;
  for (long i = 0; i < steps; ++i) {
    sum += law.step(position, 0.5).force;
    position += 1e-9;
  }
  return sum;
}

}  // namespace dashpot::benchmarks
