// Presses two tissues with the motion of a CSV file's rows `time,position,velocity` and prints both commands of each
// row.
#include <cstdio>

#include <coarse_tissue.hpp>
#include <tissue.hpp>

int main() {
  dashpot::generated::tissue tissue;
  dashpot::generated::coarse_tissue coarse_tissue;
  std::printf("# %s, %.17g s\n", dashpot::generated::tissue::certified_for::device, tissue.sample_period);
  double time, position, velocity;
  while (std::scanf("%lf,%lf,%lf", &time, &position, &velocity) == 3) {
    const auto fine = tissue.step(position, velocity);
    const auto coarse = coarse_tissue.step(float(position), float(velocity));
    std::printf("%.17g,%.17g,%.17g,%.17g\n", fine.damping, fine.force, double(coarse.damping), double(coarse.force));
  }
}
