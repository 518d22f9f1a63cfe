// The freestanding elementary functions against the standard library.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <dashpot/elementary.hpp>

namespace dashpot {
namespace {

// A square root or an exponential would be off by more than a few units in the last place somewhere.
template <class Scalar>
void expect_close_to_the_library() {
  const Scalar unit = std::numeric_limits<Scalar>::epsilon();
  for (Scalar x = Scalar(1e-20); x < Scalar(1e20); x *= Scalar(1.7)) {
    EXPECT_NEAR(square_root(x) / std::sqrt(x), 1, 2 * unit) << x;
  }
  for (Scalar x = Scalar(1e-6); x < 40; x *= Scalar(1.03)) {
    // Reducing x by multiples of ln 2 leaves an absolute error of half a unit of x.
    EXPECT_NEAR(decay(x) / std::exp(-x), 1, (2 + x) * unit) << x;
  }
}

TEST(Elementary, AgreesWithTheLibraryInDouble) { expect_close_to_the_library<double>(); }
TEST(Elementary, AgreesWithTheLibraryInFloat) { expect_close_to_the_library<float>(); }

// A limit would end in NaN or in an endless loop.
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
