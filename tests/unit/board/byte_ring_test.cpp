#include "byte_ring.hpp"

#include <thread>

#include <gtest/gtest.h>

namespace dashpot::board {
namespace {

// A byte lost, doubled or overtaken between interrupt and main loop would damage frames at random.
TEST(ByteRing, KeepsOrderBetweenTwoThreads) {
  byte_ring<64> ring;
  constexpr unsigned count = 200'000;
  std::thread producer([&] {
    for (unsigned i = 0; i < count;) {
      if (ring.push(static_cast<std::uint8_t>(i % 251))) ++i;
      else std::this_thread::yield();
    }
  });
  unsigned wrong = 0;
  for (unsigned i = 0; i < count;) {
    std::uint8_t byte = 0;
    if (!ring.pop(byte)) {
      std::this_thread::yield();
      continue;
    }
    if (byte != i++ % 251) ++wrong;
  }
  producer.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_TRUE(ring.empty());
}

// A full ring must refuse, not overwrite what waits; the firmware relies on room() to send whole frames.
TEST(ByteRing, RefusesWhenFull) {
  byte_ring<4> ring;
  for (std::uint8_t i = 0; i < 4; ++i) EXPECT_TRUE(ring.push(i));
  EXPECT_EQ(ring.room(), 0U);
  EXPECT_FALSE(ring.push(9));
  std::uint8_t byte = 0;
  EXPECT_TRUE(ring.pop(byte));
  EXPECT_EQ(byte, 0);
  EXPECT_EQ(ring.room(), 1U);
}

}  // namespace
}  // namespace dashpot::board
