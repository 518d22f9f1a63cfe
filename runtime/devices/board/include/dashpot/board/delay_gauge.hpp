// How late a message is, from two clocks that agree neither on zero nor quite on the rate: its delay beyond the
// promptest message lately seen, and beyond what the first minute lets expect, whichever is more. A delay that all
// messages share from the start is invisible to it, and so is one that creeps as slowly as clocks drift apart.
//
// Lately: the promptest message is forgotten at 244 ppm, for a clock may run that much slower than the other, more than
// quartz does. A delay that creeps at less than that would never be seen. So in the first minute the rates of the two
// clocks are compared (to 200 ppm at most: quartz differs by no more), and after it only a change of that rate by 15
// ppm is believed, which is more than the temperature makes.
#pragma once

#include <cstdint>

namespace dashpot::board {

class delay_gauge {
 public:
  // What lateness() returns for a message whose stamp cannot be: before or after all reason [ns].
  static constexpr std::int64_t beyond_reason = std::int64_t{1} << 62;

  // Lateness [ns] of a message stamped `sent` by the other clock and read at `now` by this one.
  constexpr std::int64_t lateness(std::uint64_t sent, std::uint64_t now) noexcept {
    if (!started_) begin(sent, now);
    const std::uint64_t elapsed = now - begun_at_;
    // Wrapping around like the clocks themselves: a stamp from anywhere gives some number, and no overflow.
    const auto difference = static_cast<std::int64_t>((now - sent) - zero_);
    if (!is_reasonable(difference, elapsed)) return beyond_reason;
    const std::int64_t lately = difference - follow(recent_, difference, now, recent_drift);
    const std::int64_t expected = beyond_first_minute(difference, elapsed, now);
    return lately > expected ? lately : expected;
  }

  constexpr void restart() noexcept { *this = delay_gauge(); }

 private:
  struct promptest {
    std::int64_t least = 0;  // difference of the clocks, from the first message on [ns]
    std::uint64_t at = 0;    // when it was last looked at [ns]
  };

  static constexpr int recent_drift = 12;                 // 2⁻¹²: 244 ppm
  static constexpr int settled_drift = 16;                // 2⁻¹⁶: 15 ppm
  static constexpr std::int64_t fastest_quartz = 5'000;   // 1/5000: 200 ppm
  static constexpr std::uint64_t second = 1'000'000'000;  // [ns]
  static constexpr std::uint64_t early_end = 10 * second, late_begin = 50 * second, minute = 60 * second;

  constexpr void begin(std::uint64_t sent, std::uint64_t now) noexcept {
    zero_ = now - sent;
    begun_at_ = now;
    recent_ = early_ = late_ = settled_ = {0, now};
    started_ = true;
  }

  // No link is a second early, or a minute late beyond what clocks drift apart: such a stamp is nothing to learn from.
  static constexpr bool is_reasonable(std::int64_t difference, std::uint64_t elapsed) noexcept {
    const auto drift = static_cast<std::int64_t>(elapsed >> 10);
    return difference > -static_cast<std::int64_t>(second) - drift &&
           difference < static_cast<std::int64_t>(minute) + drift;
  }

  // The least difference, rising at 2^-drift of the time that passes.
  static constexpr std::int64_t follow(promptest& one, std::int64_t difference, std::uint64_t now, int drift) noexcept {
    const auto passed = static_cast<std::int64_t>((now - one.at) >> drift);
    one.at = now;
    one.least = difference < one.least + passed ? difference : one.least + passed;
    return one.least;
  }

  constexpr std::int64_t beyond_first_minute(std::int64_t difference, std::uint64_t elapsed,
                                             std::uint64_t now) noexcept {
    if (elapsed < minute) {
      learn(difference, elapsed, now);
      return 0;
    }
    if (!compared_) return 0;  // nothing came in its last ten seconds: there is nothing to compare with
    const std::int64_t straight = difference - late_.least - drift_of(static_cast<std::int64_t>(now - late_.at));
    return straight - follow(settled_, straight, now, settled_drift);
  }

  constexpr void learn(std::int64_t difference, std::uint64_t elapsed, std::uint64_t now) noexcept {
    if (elapsed < early_end && difference <= early_.least) early_ = {difference, now};
    if (elapsed < late_begin || (compared_ && difference > late_.least)) return;
    late_ = {difference, now};
    settled_ = {0, now};
    compared_ = true;
  }

  // What the rate of the first minute makes of `time` [ns].
  constexpr std::int64_t drift_of(std::int64_t time) const noexcept {
    const auto apart = static_cast<std::int64_t>(late_.at - early_.at);
    const double rate = static_cast<double>(late_.least - early_.least) / static_cast<double>(apart);
    const double most = 1.0 / static_cast<double>(fastest_quartz);
    const double believed = rate > most ? most : rate < -most ? -most : rate;
    return static_cast<std::int64_t>(believed * static_cast<double>(time));
  }

  bool started_ = false;
  bool compared_ = false;       // late_ holds a message
  std::uint64_t zero_ = 0;      // difference of the clocks at the first message [ns]
  std::uint64_t begun_at_ = 0;  // [ns]
  promptest recent_;            // of all, forgotten quickly
  promptest early_;             // of the first ten seconds
  promptest late_;              // of the last ten of the first minute
  promptest settled_;           // of all after it, beyond the rate that these two tell
};

}  // namespace dashpot::board
