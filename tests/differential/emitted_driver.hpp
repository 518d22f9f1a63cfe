// Runs an emitted class over a motion and writes what it returns, in double, which holds every float. Compiled at the
// time of the test, with the headers that it is to run.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace differential {

struct Sample {
  double position;
  double velocity;
};

// From `motions`: the number of samples, the position of reset(), the samples. To `answers`: damping, force and energy
// of each.
template <class Law>
void run(std::FILE* motions, std::FILE* answers) {
  using scalar = typename Law::scalar;
  double count = 0, start = 0;
  if (std::fread(&count, sizeof count, 1, motions) != 1 || std::fread(&start, sizeof start, 1, motions) != 1)
    std::exit(1);
  static Law law;
  law.reset(static_cast<scalar>(start));
  for (double k = 0; k < count; k += 1) {
    Sample sample;
    if (std::fread(&sample, sizeof sample, 1, motions) != 1) std::exit(1);
    const dashpot::command<scalar> now =
        law.step(static_cast<scalar>(sample.position), static_cast<scalar>(sample.velocity));
    const double answer[] = {static_cast<double>(now.damping), static_cast<double>(now.force),
                             static_cast<double>(law.stored_energy())};
    std::fwrite(answer, sizeof(double), 3, answers);
  }
}

}  // namespace differential
