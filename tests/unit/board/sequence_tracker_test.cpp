#include <dashpot/board/sequence_tracker.hpp>

#include <random>
#include <set>

#include <gtest/gtest.h>

namespace dashpot::board {
namespace {

// A wrong verdict lets an old command reach the motor, or keeps a new one from it. Numbers wrap around on the way.
TEST(SequenceTracker, agrees_with_a_set_of_all_numbers) {
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
TEST(SequenceTracker, does_not_miss_what_came_before_the_first) {
  sequence_tracker tracker;
  tracker.note(10);
  EXPECT_EQ(tracker.note(9), arrival::late);
  EXPECT_EQ(tracker.statistics().lost, 0U);
  tracker.note(11);
  EXPECT_EQ(tracker.note(8), arrival::late);
  EXPECT_EQ(tracker.statistics().lost, 0U);
}

// Behind the window a frame can only be called late; it must not be taken for new.
TEST(SequenceTracker, calls_what_is_too_old_late) {
  sequence_tracker tracker;
  for (std::uint32_t i = 0; i < 100; ++i) tracker.note(i);
  EXPECT_EQ(tracker.note(50), arrival::late);
  EXPECT_EQ(tracker.statistics().lost, 0U);
}

// A long outage must be counted in full, and what follows must be fresh.
TEST(SequenceTracker, counts_a_long_gap) {
  sequence_tracker tracker;
  tracker.note(0);
  EXPECT_EQ(tracker.note(1'000'000), arrival::fresh);
  EXPECT_EQ(tracker.statistics().lost, 999'999U);
  EXPECT_EQ(tracker.note(999'999), arrival::late);
  EXPECT_EQ(tracker.statistics().lost, 999'998U);
}

// After a restart any number is a beginning: otherwise a board that was switched off and on would stay deaf.
TEST(SequenceTracker, begins_anew_after_restart) {
  sequence_tracker tracker;
  tracker.note(5000);
  tracker.restart();
  EXPECT_EQ(tracker.note(0), arrival::fresh);
  EXPECT_EQ(tracker.note(1), arrival::fresh);
  EXPECT_EQ(tracker.statistics().lost, 0U);
}

}  // namespace
}  // namespace dashpot::board
