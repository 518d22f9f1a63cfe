// `faithful` among options that are evaluated already.
#include <gtest/gtest.h>

#include "decompose/faithful_rule.hpp"

namespace {

using namespace dashpot::compiler;

constexpr double tolerance = 0.05;

EvaluatedOption certified(double damping, double error, double added, std::optional<double> noise = 0) {
  return {damping, error, added, true, noise};
}

EvaluatedOption uncertified(double damping, double error) { return {damping, error, std::nullopt, false, 0}; }

// Fails if an option that is the tissue no more is taken for its damping, or if not all damping that is within the
// tolerance is used.
TEST(FaithfulRule, TakesTheLargestDampingWithinTheTolerance) {
  const FaithfulChoice choice =
      choose_faithful({certified(0, 0.01, 0), certified(2, 0.05, 0), certified(3, 0.051, 0)}, tolerance);
  EXPECT_EQ(choice.chosen, 1u);
  EXPECT_EQ(choice.allowed_error, tolerance);
  EXPECT_EQ(choice.least_error, 0.01);
  EXPECT_TRUE(choice.certified);
}

// Fails if nothing would be left where no option reaches the tolerance: 1.05 × the least error is allowed then.
TEST(FaithfulRule, AllowsALittleMoreThanTheLeastReachableError) {
  const FaithfulChoice choice =
      choose_faithful({certified(0, 0.2, 0), certified(1, 0.209, 0), certified(2, 0.211, 0)}, tolerance);
  EXPECT_EQ(choice.chosen, 1u);
  EXPECT_DOUBLE_EQ(choice.allowed_error, 0.21);
}

// Fails if damping is bought with damping that passivity has to add, or if what is added is compared with that of
// options which err too much.
TEST(FaithfulRule, AddsHardlyMoreThanTheLeast) {
  const FaithfulChoice choice = choose_faithful(
      {certified(1, 0.01, 0.100), certified(2, 0.02, 0.105), certified(3, 0.02, 0.106), certified(4, 0.3, 0)},
      tolerance);
  EXPECT_EQ(choice.chosen, 1u);
  EXPECT_EQ(choice.least_added, 0.100);
}

// Fails if of equal dampings a noisier one is taken; a noise that is not known counts as the most.
TEST(FaithfulRule, PrefersLessMotorNoise) {
  EXPECT_EQ(
      choose_faithful({certified(1, 0.01, 0, {}), certified(1, 0.02, 0, 2.0), certified(1, 0.03, 0, 1.0)}, tolerance)
          .chosen,
      2u);
}

// Fails if an uncertified option is handed out while a certified one is within the tolerance.
TEST(FaithfulRule, TakesCertifiedOptionsOnly) {
  EXPECT_EQ(choose_faithful({uncertified(5, 0.01), certified(1, 0.04, 0.5)}, tolerance).chosen, 1u);
}

// Fails if a law that cannot be certified, and so is refused, sets an error that no certified one reaches.
TEST(FaithfulRule, UncertifiedErrorExcludesNoCertifiedOption) {
  const FaithfulChoice choice = choose_faithful(
      {uncertified(5, 0.01), certified(1, 0.300, 0), certified(2, 0.314, 0), certified(3, 0.316, 0)}, tolerance);
  EXPECT_EQ(choice.chosen, 2u);
  EXPECT_TRUE(choice.certified);
}

// Fails if there is no choice where nothing can be certified: it is the same without that filter.
TEST(FaithfulRule, WithoutCertificatesTheErrorDecides) {
  const FaithfulChoice choice =
      choose_faithful({uncertified(1, 0.01), uncertified(2, 0.05), uncertified(3, 0.06)}, tolerance);
  EXPECT_EQ(choice.chosen, 1u);
  EXPECT_FALSE(choice.certified);
}

}  // namespace
