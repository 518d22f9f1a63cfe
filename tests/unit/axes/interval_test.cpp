// Enclosures hold what they say: against the same operations in 50 digits.
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <numbers>

#include "axes/interval.hpp"
#include "support/random.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler::axes;
using Digits = boost::multiprecision::cpp_bin_float_50;

Interval random_interval(Random& random) {
  const double from = random.uniform(-4, 4), width = random.chance(0.3) ? 0 : random.log_uniform(1e-15, 3);
  return {from, from + width};
}

Digits member(Random& random, const Interval& a) {
  return random.chance(0.3) ? Digits(random.chance(0.5) ? a.low : a.high)
                            : Digits(a.low) + Digits(random.uniform()) * (Digits(a.high) - Digits(a.low));
}

::testing::AssertionResult holds(const Interval& a, const Digits& value) {
  if (Digits(a.low) <= value && value <= Digits(a.high)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << value << " is not in [" << a.low << ", " << a.high << "]";
}

// If an operation lost a result, nothing that is stated over a workspace would be proved.
TEST(Interval, EveryOperationEnclosesItsResults) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const Interval a = random_interval(random), b = random_interval(random);
    const Digits x = member(random, a), y = member(random, b);
    EXPECT_TRUE(holds(-a, -x));
    EXPECT_TRUE(holds(a + b, x + y));
    EXPECT_TRUE(holds(a - b, x - y));
    EXPECT_TRUE(holds(a * b, x * y));
    if (y != 0) {
      EXPECT_TRUE(holds(a / b, x / y));
    }
    EXPECT_TRUE(holds(square(a), x * x));
    if (x >= 0) {
      EXPECT_TRUE(holds(sqrt(a), sqrt(x)));
    }
    EXPECT_TRUE(holds(abs(a), abs(x)));
    EXPECT_TRUE(holds(min(a, b), std::min(x, y)));
    EXPECT_TRUE(holds(max(a, b), std::max(x, y)));
  }
}

// The C library's functions, over intervals that pass their extremes and that do not.
TEST(Interval, EveryFunctionEnclosesItsValues) {
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const Interval a = random_interval(random);
    const Digits x = member(random, a);
    EXPECT_TRUE(holds(sin(a), sin(x)));
    EXPECT_TRUE(holds(cos(a), cos(x)));
    EXPECT_TRUE(holds(atan(a), atan(x)));
    if (abs(x) <= 1) {
      EXPECT_TRUE(holds(acos(a), acos(x)));
    }
  }
}

// Enclosures of points that are wider than rounding would make every bound of a workspace needlessly large. Of the six
// results here, of less than 3 together, each is moved by 2⁻⁵² of itself either way.
TEST(Interval, PointsStayPoints) {
  const Interval x(0.7);
  EXPECT_LT((x * x + x / Interval(3) - sqrt(x)).width(), 3 * 0x1p-51);
  EXPECT_LT((sin(x) * cos(x) + acos(x) - atan(x)).width(), 1e-14);
  EXPECT_EQ((Interval(0) * x).width(), 0);
}

// Extremes inside are met, not passed over.
TEST(Interval, WavesReachTheirExtremes) {
  EXPECT_EQ(sin(Interval(1, 2)).high, 1);
  EXPECT_EQ(sin(Interval(-2, -1)).low, -1);
  EXPECT_EQ(cos(Interval(-1, 1)).high, 1);
  EXPECT_EQ(cos(Interval(3, 4)).low, -1);
  EXPECT_LT(sin(Interval(-1, 1)).high, 0.85);
  EXPECT_EQ(sin(Interval(0, 7)).width(), 2);
  EXPECT_EQ(cos(Interval(-1e9, 0)).width(), 2);
}

TEST(Interval, DivisionByIntervalWithZeroIsUnbounded) {
  const Interval any = Interval(1) / Interval(-1, 1);
  EXPECT_TRUE(std::isinf(any.low) && std::isinf(any.high));
  EXPECT_EQ((Interval(0) * any).width(), 0);
}

}  // namespace
}  // namespace dashpot::testing
