#include <dashpot/board/delay_gauge.hpp>

#include <gtest/gtest.h>

namespace dashpot::board {
namespace {

constexpr std::uint64_t millisecond = 1'000'000;  // [ns]

// A stream that stalls and then goes on as late as it has become shows no gap: only its age gives it away.
TEST(DelayGauge, sees_a_stream_that_falls_behind) {
  delay_gauge gauge;
  for (std::uint64_t t = 0; t < 100; ++t) EXPECT_LE(gauge.lateness(t * millisecond, (7 + t) * millisecond), 0);
  EXPECT_NEAR(static_cast<double>(gauge.lateness(100 * millisecond, (7 + 100 + 5) * millisecond)), 5e6, 1e4);
}

// Clocks disagree by up to some hundred parts in a million: that alone must not look like delay, in either direction.
TEST(DelayGauge, follows_a_slow_and_a_fast_clock) {
  for (const double rate : {1.0 - 2e-4, 1.0 + 2e-4}) {
    delay_gauge gauge;
    for (std::uint64_t t = 0; t < 3'600'000; t += 100) {
      const auto board = static_cast<std::uint64_t>(static_cast<double>(t * millisecond) * rate);
      EXPECT_LE(gauge.lateness(board, t * millisecond), 0) << "rate " << rate << " at " << t << " ms";
    }
  }
}

// The clocks have no common zero: a board that was switched on long before or after the host is no different.
TEST(DelayGauge, needs_no_common_zero) {
  for (const std::uint64_t zero : {std::uint64_t{0}, std::uint64_t{1} << 62}) {
    delay_gauge gauge;
    EXPECT_EQ(gauge.lateness(zero, millisecond), 0);
    EXPECT_EQ(gauge.lateness(zero + millisecond, 4 * millisecond), 2'000'000 - (3 * 1'000'000 >> 12));
  }
}

// After a restart the first message is the promptest known, however late it is compared with the old session.
TEST(DelayGauge, begins_anew_after_restart) {
  delay_gauge gauge;
  gauge.lateness(0, 0);
  gauge.restart();
  EXPECT_EQ(gauge.lateness(0, 50 * millisecond), 0);
}

}  // namespace
}  // namespace dashpot::board
