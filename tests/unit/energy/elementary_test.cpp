// The freestanding elementary functions against the standard library.
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <dashpot/elementary.hpp>

namespace dashpot {
namespace {

// A square root would not be the nearest number, or an exponential off by more than a few units in the last place.
template <class Scalar>
void expect_close_to_the_library() {
  const Scalar unit = std::numeric_limits<Scalar>::epsilon();
  for (Scalar x = Scalar(1e-20); x < Scalar(1e20); x *= Scalar(1.7)) {
    EXPECT_EQ(square_root(x), std::sqrt(x)) << x;
  }
  for (Scalar x = Scalar(1e-6); x < 40; x *= Scalar(1.03)) {
    // Reducing x by multiples of ln 2 leaves an absolute error of half a unit of x.
    EXPECT_NEAR(decay(x) / std::exp(-x), 1, (2 + x) * unit) << x;
  }
}

// A root without an instruction for it would be another, so that boards and computers differ. Beside random numbers
// those whose root is nearest to half way between two, and to a number itself.
template <class Scalar>
void expect_rounded_by_steps(int count) {
  const Scalar unit = std::numeric_limits<Scalar>::epsilon();
  std::mt19937 random(7);
  std::uniform_real_distribution<Scalar> any(1, 4);
  for (int i = 0; i < count; ++i) {
    const Scalar x = any(random), root = std::sqrt(x), square = root * root;
    for (const Scalar near :
         {x, square, square + root * unit, square - root * unit, square + 2 * unit, square - 2 * unit})
      if (near >= 1 && near < 4) {
        ASSERT_EQ(detail::root_by_steps(near), std::sqrt(near)) << near;
      }
  }
  for (int i = 0; i < 200; ++i)
    for (const Scalar x : {1 + Scalar(i) * unit, 4 - 2 * Scalar(i + 1) * unit})
      ASSERT_EQ(detail::root_by_steps(x), std::sqrt(x)) << i;
}
TEST(Elementary, RoundsRootsWithoutAnInstruction) {
  expect_rounded_by_steps<double>(300'000);
  expect_rounded_by_steps<float>(300'000);
}

// If this failed, a constant would be another root than the same number in a loop.
TEST(Elementary, HasOneRootWhereverItIsFound) {
  constexpr double two = square_root(2.0), small = square_root(3e-310), large = square_root(1.7e308);
  constexpr float three = square_root(3.0f);
  volatile double x = 2, y = 3e-310, z = 1.7e308;
  volatile float w = 3;
  EXPECT_EQ(two, square_root(double(x)));
  EXPECT_EQ(small, square_root(double(y)));
  EXPECT_EQ(large, square_root(double(z)));
  EXPECT_EQ(three, square_root(float(w)));
}

TEST(Elementary, AgreesWithTheLibraryInDouble) { expect_close_to_the_library<double>(); }
TEST(Elementary, AgreesWithTheLibraryInFloat) { expect_close_to_the_library<float>(); }

// If this failed, a limit would end in NaN or in an endless loop.
TEST(Elementary, IsTotal) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(square_root(0.0), 0);
  EXPECT_EQ(square_root(-1.0), 0);
  EXPECT_EQ(square_root(infinity), infinity);
  EXPECT_NEAR(square_root(std::numeric_limits<double>::denorm_min()), std::sqrt(5e-324), 1e-170);
  const double largest = std::numeric_limits<double>::max();
  EXPECT_NEAR(square_root(largest) / std::sqrt(largest), 1, 1e-15);
  EXPECT_EQ(decay(0.0), 1);
  EXPECT_EQ(decay(40.0), 0);
  EXPECT_EQ(decay(infinity), 0);
}

}  // namespace
}  // namespace dashpot
