// A simulated clock that oversleeps where a test tells it to.
#pragma once

#include <cstdint>

#include <dashpot/servo/period_grid.hpp>

namespace dashpot::tests {

class scripted_clock {
 public:
  static constexpr bool is_real = false;

  // Before serving `period` the loop oversleeps `periods` whole ones.
  void oversleep(std::uint64_t period, unsigned periods) {
    late_period_ = period;
    late_by_ = periods;
  }

  // Before serving `period` the machine is suspended for so long, which is too short for the loop to be late.
  void suspend(std::uint64_t period, std::int64_t nanoseconds) {
    suspended_period_ = period;
    suspended_for_ = nanoseconds;
  }

  void count_waits_in(std::uint64_t& waits) { counted_ = &waits; }

  void start(double period) noexcept {
    grid_ = period_grid(period);
    period_ns_ = static_cast<std::int64_t>(period * 1e9 + 0.5);
  }
  wake_up wait() noexcept {
    if (counted_ != nullptr) ++*counted_;
    const std::uint64_t wait = waits_++;
    const std::int64_t late = wait == late_period_ ? late_by_ * period_ns_ : 0;
    now_ = grid_.next_release() + late;
    wake_up woken = grid_.arrive(now_);
    woken.asleep = wait == suspended_period_ ? suspended_for_ : 0;
    return woken;
  }
  std::int64_t now() const noexcept { return now_; }

 private:
  period_grid grid_{1};
  std::int64_t period_ns_ = 0;
  std::int64_t now_ = 0;
  std::uint64_t waits_ = 0;
  std::uint64_t* counted_ = nullptr;
  std::uint64_t late_period_ = ~std::uint64_t{0};
  std::int64_t late_by_ = 0;
  std::uint64_t suspended_period_ = ~std::uint64_t{0};
  std::int64_t suspended_for_ = 0;  // [ns]
};

}  // namespace dashpot::tests
