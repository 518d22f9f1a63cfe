#include <gtest/gtest.h>

#include <cstdint>
#include <thread>

#include <dashpot/servo/spsc_ring.hpp>

namespace dashpot {
namespace {

// Broken, records would be reordered, overwritten or invented when the indices wrap around.
TEST(SpscRing, IsFirstInFirstOutAcrossTheEdge) {
  spsc_ring<int> ring(4);
  int in = 0;
  int out = 0;
  for (int round = 0; round < 100; ++round) {
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(ring.push(in++));
    for (int i = 0, got = -1; i < 3; ++i) {
      ASSERT_TRUE(ring.pop(got));
      ASSERT_EQ(got, out++);
    }
  }
  EXPECT_EQ(ring.dropped(), 0u);
}

// Broken, a stalled consumer would block the producer or lose the oldest records instead of the newest.
TEST(SpscRing, FullRingDropsTheNewestAndCounts) {
  spsc_ring<int> ring(5);
  ASSERT_EQ(ring.capacity(), 8u);
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(ring.push(i));
  EXPECT_TRUE(ring.is_full());
  for (int i = 8; i < 20; ++i) EXPECT_FALSE(ring.push(i));
  EXPECT_EQ(ring.dropped(), 12u);
  int got = -1;
  for (int i = 0; i < 8; ++i) {
    ASSERT_TRUE(ring.pop(got));
    EXPECT_EQ(got, i);
  }
  EXPECT_FALSE(ring.is_full());
  EXPECT_FALSE(ring.pop(got));
  EXPECT_EQ(got, 7);
}

struct pair {
  std::uint64_t number;
  std::uint64_t negated;  // torn records show
};

// Broken, a consumer in another thread would see torn, repeated or reordered records.
TEST(SpscRing, AnotherThreadSeesWholeRecordsInOrder) {
  constexpr std::uint64_t count = 200'000;
  spsc_ring<pair> ring(64);
  std::thread producer([&ring] {
    for (std::uint64_t i = 0; i < count; ++i) {
      while (ring.is_full()) std::this_thread::yield();
      ring.push({i, ~i});
    }
  });
  pair got{};
  for (std::uint64_t expected = 0; expected < count;) {
    if (!ring.pop(got)) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_EQ(got.number, expected);
    ASSERT_EQ(got.negated, ~expected);
    ++expected;
  }
  producer.join();
  EXPECT_EQ(ring.dropped(), 0u);
}

}  // namespace
}  // namespace dashpot
