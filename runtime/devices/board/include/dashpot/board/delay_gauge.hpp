// How late a message is, from two clocks that agree neither on zero nor quite on the rate: its delay beyond the
// promptest message lately seen. A delay that all messages share from the start is invisible to it.
#pragma once

#include <cstdint>

namespace dashpot::board {

class delay_gauge {
 public:
  // Lateness [ns] of a message stamped `sent` by the other clock and read at `now` by this one.
  constexpr std::int64_t lateness(std::uint64_t sent, std::uint64_t now) noexcept {
    const auto difference = static_cast<std::int64_t>(now - sent);
    const std::int64_t allowed = started_ ? least_ + drift(now) : difference;
    least_ = difference < allowed ? difference : allowed;
    last_ = now;
    started_ = true;
    return difference - least_;
  }

  constexpr void restart() noexcept { started_ = false; }

 private:
  // A clock may run 244 ppm slower than the other, more than quartz does: the promptest message is forgotten at that
  // pace.
  constexpr std::int64_t drift(std::uint64_t now) const noexcept {
    return static_cast<std::int64_t>((now - last_) >> 12);
  }

  std::int64_t least_ = 0;  // [ns]
  std::uint64_t last_ = 0;  // [ns]
  bool started_ = false;
};

}  // namespace dashpot::board
