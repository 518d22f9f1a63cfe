#include <gtest/gtest.h>

#include <dashpot/servo/period_grid.hpp>
#include <dashpot/servo/simulated_clock.hpp>

namespace dashpot {
namespace {

// Broken, a period that is no whole number of nanoseconds would drift against the device's clock.
TEST(PeriodGrid, DoesNotDriftOverADayAtThreeKilohertz) {
  constexpr std::uint64_t day = 3000ull * 86400;
  period_grid grid(1.0 / 3000);
  grid.arrive(86'399'999'666'667);  // one period before the day is over
  EXPECT_EQ(grid.next_release(), std::int64_t{86400'000'000'000});
  EXPECT_EQ(grid.arrive(grid.next_release()).period, day - 1);
}

// Broken, a late wake-up would shift all later releases.
TEST(PeriodGrid, LatenessWithinAPeriodMissesNothing) {
  period_grid grid(0.001);
  EXPECT_EQ(grid.next_release(), 1'000'000);
  const wake_up woken = grid.arrive(1'999'999);
  EXPECT_EQ(woken.period, 0u);
  EXPECT_EQ(woken.missed, 0u);
  EXPECT_EQ(woken.lateness, 999'999);
  EXPECT_EQ(woken.instant, 1'999'999);
  EXPECT_EQ(grid.next_release(), 2'000'000);
}

// Broken, the loop would catch up in a burst, or count the period it does serve as missed.
TEST(PeriodGrid, PeriodsThatAreOverAreSkippedAndCounted) {
  period_grid grid(0.001);
  const wake_up woken = grid.arrive(4'500'000);
  EXPECT_EQ(woken.period, 3u);
  EXPECT_EQ(woken.missed, 3u);
  EXPECT_EQ(woken.lateness, 3'500'000);
  EXPECT_EQ(grid.next_release(), 5'000'000);
}

// Broken, a machine suspended for hours would wrap the count of missed periods around to a harmless one.
TEST(PeriodGrid, CountOfMissedPeriodsSaturates) {
  period_grid grid(1e-9);
  EXPECT_GE(grid.arrive(std::int64_t{1} << 40).missed, 1u << 30);
}

// Broken, a simulation would depend on the machine, or be late by itself.
TEST(SimulatedClock, MeetsEveryReleaseExactly) {
  simulated_clock clock;
  clock.start(0.0001);
  for (std::uint64_t period = 0; period < 1000; ++period) {
    const wake_up woken = clock.wait();
    ASSERT_EQ(woken.period, period);
    ASSERT_EQ(woken.missed, 0u);
    ASSERT_EQ(woken.lateness, 0);
    ASSERT_EQ(clock.now(), static_cast<std::int64_t>(period + 1) * 100'000);
  }
}

}  // namespace
}  // namespace dashpot
