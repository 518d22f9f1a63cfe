// The absolute release times of a periodic loop, and what a late arrival means. Times are [ns] since the loop's start.
//
// Release k lies at (k + 1)·period from the start, rounded once to a nanosecond, so that a period that is no whole
// number of nanoseconds does not drift. Periods that are over before the loop arrives are missed: they are skipped,
// never run in a burst afterwards.
#pragma once

#include <cstdint>

namespace dashpot {

struct wake_up {
  std::uint64_t period = 0;   // which one is served, from 0
  unsigned missed = 0;        // whole periods skipped just before it
  std::int64_t lateness = 0;  // after the release that was waited for [ns]
  std::int64_t instant = 0;   // of waking up, since the loop's start [ns]
  std::int64_t asleep = 0;    // for how long the machine itself slept (suspend) since the wake-up before, at least [ns]
};

class period_grid {
 public:
  explicit constexpr period_grid(double period) noexcept : period_(period * 1e9) {}  // [s]

  constexpr std::int64_t next_release() const noexcept { return release(next_); }

  // The loop is awake at `now`, waited for next_release(), and serves the newest period that has been released.
  constexpr wake_up arrive(std::int64_t now) noexcept {
    const std::int64_t lateness = now > next_release() ? now - next_release() : 0;
    const auto over = static_cast<std::uint64_t>(static_cast<double>(lateness) / period_);
    const unsigned missed = over < most ? static_cast<unsigned>(over) : most;
    const wake_up woken{next_ + over, missed, lateness, now};
    next_ = woken.period + 1;
    return woken;
  }

 private:
  static constexpr unsigned most = 1u << 30;  // a count that still leaves room to add to

  constexpr std::int64_t release(std::uint64_t index) const noexcept {
    return static_cast<std::int64_t>(static_cast<double>(index + 1) * period_ + 0.5);
  }

  double period_;  // [ns]
  std::uint64_t next_ = 0;
};

}  // namespace dashpot
