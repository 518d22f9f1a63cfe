// The energy lemma of the law (theory, section 6) on constants as they are emitted.
#include <gtest/gtest.h>

#include "motors.hpp"
#include "support/random.hpp"

namespace dashpot::compiler {
namespace {

using dashpot::testing::Random;

MotorConstants random_lemma_motor(Random& random, double period) {
  MotorConstants motor = spring_motor(random.chance(0.3) ? 0 : random.log_uniform(1e-3, 1e4));
  const std::size_t modes = random.between(1, 8);
  for (std::size_t i = 0; i < modes; ++i)
    add_maxwell(motor, random.log_uniform(1e-3, 1e4), random.log_uniform(1e-9, 30) / period, period, true);
  return motor;
}

// Constants that were rounded once might give more work than they store.
TEST(EnergyLemma, HoldsForRoundedConstants) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const EnergyLemma lemma = check_energy_lemma(random_lemma_motor(random, 0.001));
    EXPECT_TRUE(lemma.applies);
    EXPECT_TRUE(lemma.holds) << lemma.shortfall;
  }
}

// If this failed, a step stiffness that is too small by a thousandth would pass for a tissue.
TEST(EnergyLemma, RefusesTooSmallAStepStiffness) {
  MotorConstants motor = spring_motor(0);
  add_maxwell(motor, 1000, 0.001, 0.001, true);
  motor.step_stiffness *= 0.49;  // the least is c/2
  const EnergyLemma lemma = check_energy_lemma(motor);
  EXPECT_FALSE(lemma.holds);
  EXPECT_NEAR(lemma.shortfall, 10, 0.01);
}

// If this failed, modes that the estimate drives, which do not obey the lemma, would be said to.
TEST(EnergyLemma, DoesNotApplyToVelocityDrivenModes) {
  MotorConstants motor;
  add_maxwell(motor, 1000, 5, 0.001, false);
  EXPECT_FALSE(check_energy_lemma(motor).applies);
}

}  // namespace
}  // namespace dashpot::compiler
