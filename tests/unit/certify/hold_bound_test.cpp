// The hold certificate's constant and the supremum of the sampled one are the same number (theory, section 6a).
#include <gtest/gtest.h>

#include "certify/hold_bound.hpp"
#include "motors.hpp"
#include "support/random.hpp"

namespace dashpot::compiler {
namespace {

using dashpot::testing::Random;

// The two certificates would disagree where both apply.
TEST(HoldBound, MeetsTheSupremumOnRandomNetworks) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double period = random.log_uniform(1e-5, 1e-2);
    MotorConstants motor = spring_motor(random.chance(0.3) ? 0 : random.log_uniform(1e-3, 1e4));
    const std::size_t modes = random.between(motor.static_stiffness > 0 ? 0 : 1, 12);
    for (std::size_t i = 0; i < modes; ++i)
      add_maxwell(motor, random.log_uniform(1e-3, 1e4), random.log_uniform(1e-6, 1e2) / period, period, true);
    const double beta = hold_stiffness(motor).convert_to<double>();
    const SampledBound bound = bound_of(motor, plain_loop(period));
    EXPECT_NEAR(bound.attained / (beta * period), 1, 1e-9);
    EXPECT_GE(bound.needed, beta * period * (1 - 1e-12));
    EXPECT_LE(bound.needed, beta * period * (1 + 1e-6));
  }
}

// A jittery loop would be promised what only a punctual one keeps.
TEST(HoldBound, CountsTheLongestHold) {
  SampledLoop loop = plain_loop(0.001);
  loop.jitter = 0.0005;
  const PassivityBound bound = passivity_bound(spring_motor(1000), loop);
  EXPECT_EQ(bound.proof, Proof::hold);
  EXPECT_NEAR(bound.needed, 0.75, 1e-15);
  EXPECT_GE(Rational(bound.needed), Rational(500) * (Rational(0.001) + Rational(0.0005)));
}

// A certificate without a condition would be handed out where one of its conditions fails.
TEST(HoldBound, GivesWayToTheSampledOne) {
  SampledLoop late = plain_loop(0.001), lagging = plain_loop(0.001);
  late.delay_samples = 1;
  lagging.amplifier_lag = 0.0002;
  EXPECT_EQ(passivity_bound(spring_motor(1000), late).proof, Proof::sampled);
  EXPECT_EQ(passivity_bound(spring_motor(1000), lagging).proof, Proof::sampled);
  EXPECT_EQ(passivity_bound(damper_motor(-1), plain_loop(0.001)).proof, Proof::sampled);
  EXPECT_EQ(passivity_bound(std::nullopt, plain_loop(0.001)).proof, Proof::none);
}

}  // namespace
}  // namespace dashpot::compiler
