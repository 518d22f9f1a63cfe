#include <dashpot/servo/monotonic_clock.hpp>

#include <cerrno>
#include <ctime>

namespace dashpot {
namespace {

constexpr std::int64_t nanoseconds = 1'000'000'000;  // a second

template <clockid_t Clock>
std::int64_t read_clock() noexcept {
  timespec time{};
  clock_gettime(Clock, &time);
  return std::int64_t{time.tv_sec} * nanoseconds + time.tv_nsec;
}

void sleep_until(std::int64_t instant) noexcept {
  const timespec until{static_cast<time_t>(instant / nanoseconds), static_cast<long>(instant % nanoseconds)};
  while (clock_nanosleep(CLOCK_BOOTTIME, TIMER_ABSTIME, &until, nullptr) == EINTR) {}
}

}  // namespace

const machine_time& real_machine_time() noexcept {
  static constexpr machine_time real{read_clock<CLOCK_BOOTTIME>, read_clock<CLOCK_MONOTONIC>, sleep_until};
  return real;
}

void monotonic_clock::start(double period) noexcept {
  grid_ = period_grid(period);
  slept();
  origin_ = time_->since_boot();
}

wake_up monotonic_clock::wait() noexcept {
  time_->sleep_until(origin_ + grid_.next_release());
  const std::int64_t asleep = slept();
  wake_up woken = grid_.arrive(now());
  woken.asleep = asleep;
  return woken;
}

std::int64_t monotonic_clock::now() const noexcept { return time_->since_boot() - origin_; }

// Since the call before, at least. The two clocks cannot be read at one instant: between two readings of the one the
// other is bounded from both sides, and an interruption in between only makes the bounds wider.
std::int64_t monotonic_clock::slept() noexcept {
  const std::int64_t before = time_->awake();
  const std::int64_t boot = time_->since_boot();
  const std::int64_t after = time_->awake();
  const std::int64_t least = boot - after - most_asleep_;
  most_asleep_ = boot - before;
  return least > 0 ? least : 0;
}

}  // namespace dashpot
