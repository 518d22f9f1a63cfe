// The clock of a simulated loop: every release is met exactly and at once, so that a run is as fast as the machine and
// the same every time. Computing takes no time on it.
#pragma once

#include <cstdint>

#include <dashpot/servo/period_grid.hpp>

namespace dashpot {

class simulated_clock {
 public:
  static constexpr bool is_real = false;

  void start(double period) noexcept {  // [s]
    grid_ = period_grid(period);
    now_ = 0;
  }
  wake_up wait() noexcept {
    now_ = grid_.next_release();
    return grid_.arrive(now_);
  }
  std::int64_t now() const noexcept { return now_; }  // since start() [ns]

 private:
  period_grid grid_{1};
  std::int64_t now_ = 0;  // [ns]
};

}  // namespace dashpot
