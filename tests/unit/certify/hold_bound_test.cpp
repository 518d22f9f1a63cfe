// The hold certificate's constant and the supremum of the sampled one are the same number (theory, section 6a).
#include <gtest/gtest.h>

#include "certify/hold_bound.hpp"
#include "motors.hpp"
#include "support/random.hpp"

namespace dashpot::compiler {
namespace {

using dashpot::testing::Random;

// If this failed, the two certificates would disagree where both apply.
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

// If this failed, a jittery loop would be promised what only a punctual one keeps.
TEST(HoldBound, CountsTheLongestHold) {
  SampledLoop loop = plain_loop(0.001);
  loop.jitter = 0.0005;
  const PassivityBound bound = passivity_bound(spring_motor(1000), loop);
  EXPECT_EQ(bound.proof, Proof::hold);
  EXPECT_NEAR(bound.needed, 0.75, 1e-15);
  EXPECT_GE(Rational(bound.needed), Rational(500) * (Rational(0.001) + Rational(0.0005)));
}

// If this failed, a certificate without a condition would be handed out where one of its conditions fails.
TEST(HoldBound, GivesWayToTheSampledOne) {
  SampledLoop late = plain_loop(0.001), lagging = plain_loop(0.001);
  late.delay_samples = 1;
  lagging.amplifier_lag = 0.0002;
  EXPECT_EQ(passivity_bound(spring_motor(1000), late).proof, Proof::hold);
  EXPECT_EQ(passivity_bound(spring_motor(1000), lagging).proof, Proof::sampled);
  EXPECT_EQ(passivity_bound(damper_motor(-1), plain_loop(0.001)).proof, Proof::sampled);
  EXPECT_EQ(passivity_bound(std::nullopt, plain_loop(0.001)).proof, Proof::none);
}

// If this failed, β would not count 1 + 2n times with n samples of delay, or the longest hold not as before.
TEST(HoldBound, CountsTheDelay) {
  for (const unsigned delay : {1u, 2u, 5u}) {
    SampledLoop loop = plain_loop(0.001);
    loop.delay_samples = delay;
    loop.jitter = 0.0002;
    const PassivityBound bound = passivity_bound(spring_motor(1000), loop);
    EXPECT_EQ(bound.proof, Proof::hold);
    EXPECT_FALSE(bound.constant_period_only);
    EXPECT_NEAR(bound.needed, 500 * 0.0012 * (1 + 2 * delay), 1e-12);
  }
}

// If this failed, nothing would be proved where samples stray by more than a period; or something where one may be read
// before the command before it acts.
TEST(HoldBound, LeavesNoSampleBeforeTheCommandBeforeIt) {
  SampledLoop loop = plain_loop(0.001);
  loop.jitter = 0.0015;
  EXPECT_NEAR(passivity_bound(spring_motor(1000), loop).needed, 500 * 0.0025, 1e-12);
  loop.jitter = 0.0005;
  loop.write_earliest = loop.write_latest = 0.0004;
  EXPECT_EQ(passivity_bound(spring_motor(1000), loop).proof, Proof::hold);
  loop.write_latest = 0.0006;
  EXPECT_EQ(passivity_bound(spring_motor(1000), loop).proof, Proof::none);
}

// If this failed, more would be asked of a late network than one of the two statements asks.
TEST(HoldBound, TheSmallerBoundIsStated) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    SampledLoop loop = plain_loop(random.log_uniform(1e-4, 1e-2));
    loop.delay_samples = unsigned(random.between(1, 4));
    loop.jitter = loop.sample_period * random.uniform();
    MotorConstants motor = spring_motor(random.log_uniform(1, 1e3));
    for (std::size_t i = random.between(0, 3); i > 0; --i)
      add_maxwell(motor, random.log_uniform(1, 1e3), random.log_uniform(1e-3, 10) / loop.sample_period,
                  loop.sample_period, true);
    const double beta = hold_stiffness(motor).convert_to<double>(), longest = loop.longest_hold();
    const double supremum = bound_of(motor, loop).needed * longest / loop.sample_period;
    const double held = beta * (1 + 2 * loop.delay_samples) * longest;
    EXPECT_LE(supremum, held * (1 + 1e-6));
    const PassivityBound bound = passivity_bound(motor, loop);
    EXPECT_LE(bound.needed, std::min(supremum, held) * (1 + 1e-6));
    EXPECT_GE(bound.needed, std::min(supremum, held) * (1 - 1e-12));
    EXPECT_FALSE(bound.constant_period_only);
  }
}

// If this failed, jitter without lag would cost nothing, or not be covered; with lag it would be said to be.
TEST(SampledStatement, CoversJitterWithoutLagAlone) {
  SampledLoop loop = differencing_loop(0.001, 5);
  loop.delay_samples = 1;
  MotorConstants motor = damper_motor(5);
  motor.static_stiffness = 500;
  const PassivityBound punctual = passivity_bound(motor, loop);
  EXPECT_NEAR(punctual.needed, 3.352243202, 1e-6);
  loop.jitter = 0.0005;
  const PassivityBound late = passivity_bound(motor, loop);
  EXPECT_FALSE(late.constant_period_only);
  EXPECT_NEAR(late.needed, 1.5 * punctual.needed, 1e-12);
  loop.amplifier_lag = 0.0002;
  EXPECT_TRUE(passivity_bound(motor, loop).constant_period_only);
  loop.velocity.estimator = estimator_kind::foaw;
  loop.velocity.window = 8;
  loop.amplifier_lag = loop.jitter = 0;
  const double adaptive = passivity_bound(motor, loop).needed;
  loop.jitter = 0.0005;
  EXPECT_NEAR(passivity_bound(motor, loop).needed, 1.5 * adaptive, 1e-12);
}

}  // namespace
}  // namespace dashpot::compiler
