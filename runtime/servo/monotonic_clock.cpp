#include <dashpot/servo/monotonic_clock.hpp>

#include <cerrno>
#include <ctime>

namespace dashpot {
namespace {

constexpr std::int64_t nanoseconds = 1'000'000'000;  // a second

std::int64_t read_clock() noexcept {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * nanoseconds + time.tv_nsec;
}

void sleep_until(std::int64_t instant) noexcept {
  const timespec until{static_cast<time_t>(instant / nanoseconds), static_cast<long>(instant % nanoseconds)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {}
}

}  // namespace

void monotonic_clock::start(double period) noexcept {
  grid_ = period_grid(period);
  origin_ = read_clock();
}

wake_up monotonic_clock::wait() noexcept {
  sleep_until(origin_ + grid_.next_release());
  return grid_.arrive(now());
}

std::int64_t monotonic_clock::now() const noexcept { return read_clock() - origin_; }

}  // namespace dashpot
