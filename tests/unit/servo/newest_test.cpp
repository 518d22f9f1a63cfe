// The handover that examples/tunable_wall shows to users.
#include "../../../examples/tunable_wall/newest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <thread>

namespace dashpot {
namespace {

// So large that no machine copies it at once.
using page = std::array<unsigned, 4096>;

page page_of(unsigned number) {
  page result;
  result.fill(number);
  return result;
}

// If this fails, a loop may run with half of one setting and half of the next, with one that is over, or without the
// last.
TEST(Newest, HandsOverWholeValuesAndTheLastOne) {
  constexpr unsigned last = 20'000;
  newest<page> slider;
  std::thread writer([&] {
    for (unsigned number = 1; number <= last; ++number) slider.put(page_of(number));
  });
  page seen = page_of(0);
  for (unsigned before = 0; before < last; before = seen[0]) {
    if (!slider.take(seen)) continue;
    EXPECT_GT(seen[0], before);
    EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [&](unsigned number) { return number == seen[0]; }));
    if (testing::Test::HasFailure()) break;
  }
  writer.join();
}

// If this fails, a loop sets the same values anew every sample, or takes what nobody has put.
TEST(Newest, TakesEachValueOnce) {
  newest<int> slider;
  int value = 7;
  EXPECT_FALSE(slider.take(value));
  EXPECT_EQ(value, 7);
  slider.put(1);
  slider.put(2);
  EXPECT_TRUE(slider.take(value));
  EXPECT_EQ(value, 2);
  EXPECT_FALSE(slider.take(value));
}

}  // namespace
}  // namespace dashpot
