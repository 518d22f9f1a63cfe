// The clock of a loop on real hardware: sleeps until absolute times, so that no error accumulates. Its time is
// CLOCK_BOOTTIME, which goes on while the machine is suspended: CLOCK_MONOTONIC stops, and a loop on it would go on
// after hours as if nothing had been. How far the two have drifted apart tells how long the machine slept.
#pragma once

#include <cstdint>

#include <dashpot/servo/period_grid.hpp>

namespace dashpot {

// Where a clock has its time from; a test has another.
struct machine_time {
  std::int64_t (*since_boot)() noexcept;  // CLOCK_BOOTTIME [ns]
  std::int64_t (*awake)() noexcept;       // CLOCK_MONOTONIC [ns]
  void (*sleep_until)(std::int64_t since_boot) noexcept;
};
const machine_time& real_machine_time() noexcept;  // no system call for reading where the kernel offers a vDSO

class monotonic_clock {
 public:
  static constexpr bool is_real = true;

  monotonic_clock() noexcept : monotonic_clock(real_machine_time()) {}
  explicit monotonic_clock(const machine_time& time) noexcept : time_(&time) {}

  void start(double period) noexcept;  // [s]; the first release is one period from now
  wake_up wait() noexcept;             // sleeps until the next release; returns at once when that is past
  std::int64_t now() const noexcept;   // since start() [ns]

 private:
  std::int64_t slept() noexcept;

  const machine_time* time_;
  period_grid grid_{1};
  std::int64_t origin_ = 0;       // since boot at start() [ns]
  std::int64_t most_asleep_ = 0;  // before: the machine cannot have slept longer since it was switched on [ns]
};

}  // namespace dashpot
