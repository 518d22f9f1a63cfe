#include <dashpot/board/delay_gauge.hpp>

#include <gtest/gtest.h>

namespace dashpot::board {
namespace {

constexpr std::uint64_t millisecond = 1'000'000;  // [ns]

// A stream that stalls and then goes on as late as it has become shows no gap: only its age gives it away.
TEST(DelayGauge, SeesAStreamThatFallsBehind) {
  delay_gauge gauge;
  for (std::uint64_t t = 0; t < 100; ++t) EXPECT_LE(gauge.lateness(t * millisecond, (7 + t) * millisecond), 0);
  EXPECT_NEAR(static_cast<double>(gauge.lateness(100 * millisecond, (7 + 100 + 5) * millisecond)), 5e6, 1e4);
}

// Clocks disagree by up to some hundred parts in a million: that alone must not look like delay, in either direction.
TEST(DelayGauge, FollowsASlowAndAFastClock) {
  for (const double rate : {1.0 - 2e-4, 1.0 + 2e-4}) {
    delay_gauge gauge;
    for (std::uint64_t t = 0; t < 3'600'000; t += 100) {
      const auto board = static_cast<std::uint64_t>(static_cast<double>(t * millisecond) * rate);
      EXPECT_LE(gauge.lateness(board, t * millisecond), 0) << "rate " << rate << " at " << t << " ms";
    }
  }
}

// The clocks have no common zero: a board that was switched on long before or after the host is no different.
TEST(DelayGauge, NeedsNoCommonZero) {
  for (const std::uint64_t zero : {std::uint64_t{0}, std::uint64_t{1} << 62}) {
    delay_gauge gauge;
    EXPECT_EQ(gauge.lateness(zero, millisecond), 0);
    EXPECT_EQ(gauge.lateness(zero + millisecond, 4 * millisecond), 2'000'000 - (3 * 1'000'000 >> 12));
  }
}

// After a restart the first message is the promptest known, however late it is compared with the old session.
TEST(DelayGauge, BeginsAnewAfterRestart) {
  delay_gauge gauge;
  gauge.lateness(0, 0);
  gauge.restart();
  EXPECT_EQ(gauge.lateness(0, 50 * millisecond), 0);
}

// A stamp from a clock that was set, or from memory that was never written, must neither overflow nor be taken for
// prompt, and what comes after it must be judged as if it had not been.
TEST(DelayGauge, TakesNoAbsurdStampForAPromptOne) {
  for (const std::uint64_t stamp : {std::uint64_t{0}, std::uint64_t{1} << 62, (std::uint64_t{1} << 63) - 1,
                                    std::uint64_t{1} << 63, ~std::uint64_t{0}}) {
    delay_gauge gauge;
    constexpr std::uint64_t start = 1'000'000 * millisecond;
    for (std::uint64_t t = 0; t < 100; ++t) gauge.lateness(start + t * millisecond, t * millisecond);
    EXPECT_GT(gauge.lateness(stamp, 100 * millisecond), std::int64_t{1} << 40) << stamp;
    EXPECT_LE(gauge.lateness(start + 101 * millisecond, 101 * millisecond), 0) << stamp;
    EXPECT_NEAR(static_cast<double>(gauge.lateness(start + 102 * millisecond, 107 * millisecond)), 5e6, 1e4) << stamp;
  }
}

// How late the last message of an hour is found, in which the delay grows by `creep` from second `since` on [ns].
std::int64_t lateness_after_an_hour(double creep, std::uint64_t since) {
  delay_gauge gauge;
  std::int64_t last = 0;
  for (std::uint64_t t = 0; t < 3'600'000; t += 10) {
    const double crept = t > since * 1000 ? creep * static_cast<double>(t - since * 1000) * 1e6 : 0;
    last = gauge.lateness(t * millisecond, t * millisecond + static_cast<std::uint64_t>(crept));
  }
  return last;
}

// 864 ms in an hour are 240 parts in a million, just what clocks are allowed to drift apart: a queue that fills that
// slowly on the way would never be noticed.
TEST(DelayGauge, SeesADelayThatCreeps) {
  EXPECT_GT(lateness_after_an_hour(240e-6, 0), 80'000'000) << "from the first second on: beyond what quartz does";
  EXPECT_GT(lateness_after_an_hour(240e-6, 60), 780'000'000) << "after a first minute that tells the clocks' rates";
  EXPECT_GT(lateness_after_an_hour(50e-6, 60), 120'000'000);
  EXPECT_LE(lateness_after_an_hour(10e-6, 60), 0) << "the temperature";
}

}  // namespace
}  // namespace dashpot::board
