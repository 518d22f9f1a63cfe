// The clock of a loop on real hardware: sleeps until absolute times of CLOCK_MONOTONIC, so that no error accumulates.
#pragma once

#include <cstdint>

#include <dashpot/servo/period_grid.hpp>

namespace dashpot {

class monotonic_clock {
 public:
  static constexpr bool is_real = true;

  void start(double period) noexcept;  // [s]; the first release is one period from now
  wake_up wait() noexcept;             // sleeps until the next release; returns at once when that is past
  std::int64_t now() const noexcept;   // since start() [ns]; no system call where the kernel offers a vDSO

 private:
  period_grid grid_{1};
  std::int64_t origin_ = 0;  // CLOCK_MONOTONIC at start() [ns]
};

}  // namespace dashpot
