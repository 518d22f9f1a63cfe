// What a Maxwell element keeps of a sample, where it is computed in the loop.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <boost/math/special_functions/expm1.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>
#include <limits>

#include "exponential_bits.hpp"
#include "support/random.hpp"
#include "support/shell_command.hpp"

namespace dashpot::testing {
namespace {

using Real = boost::multiprecision::cpp_bin_float_50;

template <class Scalar>
void expect_within_three_units() {
  Random random(20);
  const Real unit = std::numeric_limits<Scalar>::epsilon() / 2;
  const Scalar smallest = std::numeric_limits<Scalar>::min(), largest = std::numeric_limits<Scalar>::max();
  for (int i = 0; i < 60000; ++i) {
    // Every magnitude, and in more detail where the two branches meet.
    const double any =
        i % 3 == 0 ? random.log_uniform(double(smallest) * 1e-3, double(largest)) : random.log_uniform(1e-4, 60);
    const Scalar x = static_cast<Scalar>(i % 5 == 0 ? random.uniform(0.6, 0.8) : any);
    const Scalar result = mean_decay(x);
    if (result < smallest) continue;
    const Real exact = -boost::math::expm1(Real(-Real(x))) / Real(x);
    ASSERT_LE(abs(Real(result) - exact), 3 * unit * exact) << x;
  }
}

// If this failed, a relaxation set at run time would differ from the law by more than rounding.
TEST(Exponential, IsWithinThreeUnitsOfRoundoffInDouble) { expect_within_three_units<double>(); }
TEST(Exponential, IsWithinThreeUnitsOfRoundoffInFloat) { expect_within_three_units<float>(); }

// If this failed, a limit would end in NaN, which no later set() would take out of the states, or a NaN would go
// unnoticed.
TEST(Exponential, IsTotal) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(mean_decay(0.0), 1);
  EXPECT_EQ(mean_decay(-1.0), 1);
  EXPECT_EQ(mean_decay(infinity), 0);
  EXPECT_EQ(mean_decay(std::numeric_limits<double>::denorm_min()), 1);
  EXPECT_EQ(mean_decay(std::numeric_limits<float>::denorm_min()), 1);
  EXPECT_GT(mean_decay(std::numeric_limits<float>::max()), 0);
  EXPECT_TRUE(std::isnan(mean_decay(std::numeric_limits<double>::quiet_NaN())));
}

// A constant of the emitted code could not be computed before it runs, and with it no object initialised by constants.
TEST(Exponential, IsAConstantExpression) {
  static_assert(mean_decay(0.0) == 1 && mean_decay(1.0) > 0.632 && mean_decay(1.0) < 0.6322);
  constexpr double by_the_compiler = mean_decay(0.3);
  volatile double argument = 0.3;
  EXPECT_EQ(by_the_compiler, mean_decay(double(argument)));
}

// If this failed, a board would render another network than the one that was simulated.
TEST(Exponential, HasTheSameBitsOnACortexM) {
  ASSERT_NE(std::string(DASHPOT_BOARD_PROGRAM), "") << "arm-none-eabi-g++ is not installed (package gcc-arm-none-eabi)";
  ASSERT_NE(std::string(DASHPOT_QEMU), "") << "qemu-system-arm is not installed (package qemu-system-arm)";
  const Finished board = run_command(
      fmt::format("timeout 60 '{}' -M mps2-an386 -nographic -monitor none -serial none -chardev stdio,id=s0 "
                  "-semihosting-config enable=on,target=native,chardev=s0 -kernel '{}' < /dev/null",
                  DASHPOT_QEMU, DASHPOT_BOARD_PROGRAM));
  const auto in_double = exponential_bits<double, unsigned long long>(),
             in_float = exponential_bits<float, unsigned long long>();
  EXPECT_EQ(board.output, fmt::format("{:016x}{:016x}", in_double, in_float));
}

}  // namespace
}  // namespace dashpot::testing
