#include "isotropic.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <laws.hpp>

#include "says.hpp"

namespace {

using namespace dashpot::paper;

const Isotropic& isotropic() {
  static const Isotropic measured = measure_isotropic();
  return measured;
}
const Isotropic::Part& motors() { return isotropic().parts.at(0); }
const Isotropic::Part& joint_brakes() { return isotropic().parts.at(1); }
const Isotropic::Part& coupled_brakes() { return isotropic().parts.at(2); }

// Fails if dashpot does not certify both ways to use the brakes, or adds damping for it, which would be felt.
TEST(Isotropic, IsCertifiedByBrakesWithoutMoreDamping) {
  EXPECT_TRUE(laws::isotropic_joint_brakes::certified_for::is_certified);
  EXPECT_TRUE(laws::isotropic_coupled_brakes::certified_for::is_certified);
  EXPECT_FALSE(laws::isotropic_motors_alone::certified_for::is_certified);
}

// Fails if a force is off by another amount than its lateness makes: 8 samples at 2 Hz are an angle of 0.1, of all of
// the force and of its coupled part. Brakes on sum and difference are off by what the arm turns within half a period.
TEST(Isotropic, ErrsByThePartThatIsLate) {
  EXPECT_NEAR(motors().error, 0.10, 0.01);
  EXPECT_LT(joint_brakes().error, 0.7 * motors().error);
  EXPECT_GT(joint_brakes().error, 0.3 * motors().error);
  EXPECT_LT(coupled_brakes().error, 0.005);
}

// Fails if the power is not that of a late estimate: its real part by motors alone, (1 − c² Re G)/(1 − c²) by brakes on
// the joints, all of b v² by brakes on sum and difference. The circles are not points: their radius over the link,
// squared, is 3e-4 at 5 Hz.
TEST(Isotropic, TakesThePowerOfClosedForms) {
  for (const Isotropic::Part& part : isotropic().parts)
    for (const Isotropic::Small& small : part.small)
      EXPECT_NEAR(small.share, small.expected, 2e-3) << part.name << ", " << small.frequency << " Hz";
}

// Fails if motors alone do not give energy on fast circles, or if brakes let some through, or at some time.
TEST(Isotropic, GivesEnergyByMotorsAloneOnly) {
  EXPECT_LT(motors().lowest_share(), -0.2);
  EXPECT_GT(joint_brakes().lowest_share(), 0.9);
  EXPECT_GT(coupled_brakes().lowest_share(), 0.99);
  EXPECT_LT(motors().drawn.back().taken, -1e-4);
  EXPECT_GE(least_taken(joint_brakes().drawn), 0);
  EXPECT_GE(least_taken(coupled_brakes().drawn), 0);
}

// Fails if the words stay when the numbers change sides.
TEST(Isotropic, SaysWhatTheNumbersSay) {
  EXPECT_TRUE(says(show(isotropic()), "motors alone give energy"));
  EXPECT_TRUE(says(show(isotropic()), "never with brakes"));
  Isotropic other = isotropic();
  for (Isotropic::Small& small : other.parts[0].small) small.share = 0.1;
  other.parts[1].small[3].share = -0.1;
  EXPECT_TRUE(says(show(other), "motors alone give no energy"));
  EXPECT_TRUE(says(show(other), "also with brakes"));
}

}  // namespace
