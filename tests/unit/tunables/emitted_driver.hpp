// Runs an emitted class over a recorded schedule and writes what it returns without rounding it. Compiled at the time
// of the test, with the headers that it is to run.
#pragma once

#include <cstdio>
#include <vector>

namespace tunables {

// A row is position, velocity, 0 or 1 where values are set before the sample, the values. All double.
template <class Law, int Count>
void run(const char* schedule, const char* output) {
  using scalar = typename Law::scalar;
  static Law law;
  law.reset(0);
  std::FILE* in = std::fopen(schedule, "rb");
  std::FILE* out = std::fopen(output, "wb");
  double row[3 + Count];
  while (std::fread(row, sizeof(double), 3 + Count, in) == 3 + Count) {
    unsigned clamped = 0;
    if (row[2] != 0) {
      scalar values[Count];
      for (int i = 0; i < Count; ++i) values[i] = static_cast<scalar>(row[3 + i]);
      typename Law::parameters wanted;
      static_assert(sizeof wanted == sizeof values, "parameters are numbers in their order");
      __builtin_memcpy(static_cast<void*>(&wanted), values, sizeof values);
      clamped = law.set(wanted);
    }
    const auto now = law.step(static_cast<scalar>(row[0]), static_cast<scalar>(row[1]));
    const double answer[] = {static_cast<double>(now.damping), static_cast<double>(now.force),
                             static_cast<double>(law.stored_energy()), static_cast<double>(clamped)};
    std::fwrite(answer, sizeof(double), 4, out);
  }
  std::fclose(in);
  std::fclose(out);
}

}  // namespace tunables
