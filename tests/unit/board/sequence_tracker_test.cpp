#include <dashpot/board/sequence_tracker.hpp>

#include <random>
#include <set>

#include <gtest/gtest.h>

namespace dashpot::board {
namespace {

// A wrong verdict lets an old command reach the motor, or keeps a new one from it. Numbers wrap around on the way.
TEST(SequenceTracker, AgreesWithASetOfAllNumbers) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    const std::uint64_t first = 0xFFFF'FF00U;
    std::uint64_t newest = first;
    std::set<std::uint64_t> seen = {newest};
    sequence_tracker tracker;
    ASSERT_EQ(tracker.note(static_cast<std::uint32_t>(newest)), arrival::fresh);
    for (int i = 0; i < 2000; ++i) {
      const std::uint64_t next = std::max(first, newest + random() % 6 - random() % 30);
      const arrival expected = seen.count(next) != 0 ? arrival::repeated
                               : next > newest       ? arrival::fresh
                                                     : arrival::late;
      ASSERT_EQ(tracker.note(static_cast<std::uint32_t>(next)), expected) << "seed " << seed << ", step " << i;
      newest = std::max(newest, next);
      seen.insert(next);
      ASSERT_EQ(tracker.statistics().lost, newest - first + 1 - seen.size()) << "seed " << seed << ", step " << i;
    }
  }
}

// Nothing is known of numbers before the first: an overtaken one must not make the count of lost frames negative.
TEST(SequenceTracker, DoesNotMissWhatCameBeforeTheFirst) {
  sequence_tracker tracker;
  tracker.note(10);
  EXPECT_EQ(tracker.note(9), arrival::late);
  EXPECT_EQ(tracker.statistics().lost, 0U);
  tracker.note(11);
  EXPECT_EQ(tracker.note(8), arrival::late);
  EXPECT_EQ(tracker.statistics().lost, 0U);
}

// Behind the window a frame can only be called late; it must not be taken for new.
TEST(SequenceTracker, CallsWhatIsTooOldLate) {
  sequence_tracker tracker;
  for (std::uint32_t i = 0; i < 100; ++i) tracker.note(i);
  EXPECT_EQ(tracker.note(50), arrival::late);
  EXPECT_EQ(tracker.statistics().lost, 0U);
}

// A long outage must be counted in full, and what follows must be fresh.
TEST(SequenceTracker, CountsALongGap) {
  sequence_tracker tracker;
  tracker.note(0);
  EXPECT_EQ(tracker.note(1'000), arrival::fresh);
  EXPECT_EQ(tracker.statistics().lost, 999U);
  EXPECT_EQ(tracker.note(999), arrival::late);
  EXPECT_EQ(tracker.statistics().lost, 998U);
  for (std::uint32_t i = 1'000'000; i < 1'000'003; ++i) EXPECT_EQ(tracker.note(i), arrival::late) << i;
  EXPECT_EQ(tracker.note(1'000'003), arrival::anew);
  EXPECT_EQ(tracker.note(1'000'004), arrival::fresh);
  EXPECT_EQ(tracker.statistics().lost, 998U + 998'999U)
      << "1,001 … 999,999: those that only came too early are not lost";
}

// A check sum of 16 bits lets one damaged frame in 65,536 pass. One wild number must not make all that follow seem old.
TEST(SequenceTracker, IgnoresOneWildNumber) {
  for (const std::uint32_t wild : {0x7FFF'0000U, 0x8000'0100U, 0xFFFF'0000U, 5'000U}) {
    sequence_tracker tracker;
    for (std::uint32_t i = 100; i < 200; ++i) {
      ASSERT_EQ(tracker.note(i), arrival::fresh) << "after " << wild;
      if (i % 3 == 0) {
        ASSERT_EQ(tracker.note(wild + i), arrival::late);
      }
    }
    EXPECT_EQ(tracker.statistics().lost, 0U);
  }
}

// A peer that begins to count anew must be heard again; single old frames that come again between sound ones must not.
TEST(SequenceTracker, TakesARunOfConsecutiveNumbersForANewBeginning) {
  sequence_tracker tracker;
  for (std::uint32_t i = 5'000; i < 5'100; ++i) tracker.note(i);
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(tracker.note(i), arrival::late);
  EXPECT_EQ(tracker.note(5'100), arrival::fresh) << "the old numbers go on";
  for (std::uint32_t i = 3; i < 6; ++i) EXPECT_EQ(tracker.note(i), arrival::late);
  EXPECT_EQ(tracker.note(6), arrival::anew);
  for (std::uint32_t i = 7; i < 50; ++i) EXPECT_EQ(tracker.note(i), arrival::fresh);
  EXPECT_EQ(tracker.note(48), arrival::repeated);
}

// After a restart any number is a beginning: otherwise a board that was switched off and on would stay deaf.
TEST(SequenceTracker, BeginsAnewAfterRestart) {
  sequence_tracker tracker;
  tracker.note(5000);
  tracker.restart();
  EXPECT_EQ(tracker.note(0), arrival::fresh);
  EXPECT_EQ(tracker.note(1), arrival::fresh);
  EXPECT_EQ(tracker.statistics().lost, 0U);
}

}  // namespace
}  // namespace dashpot::board
