// Hands: what is passive, and what passive hands do.
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include <dashpot/simulated/draw.hpp>

#include "plain_device.hpp"

namespace dashpot::simulated {
namespace {

// A passive hand of `states` states drawn from a seed: A = J − R with J skew and R = L Lᵀ, C = Bᵀ.
hand random_passive_hand(unsigned seed, unsigned states) {
  std::uint64_t index = 0;
  const auto draw = [&] { return 2 * draw_uniform(seed, draw_stream::sensor_noise, index++) - 1; };
  hand user;
  user.mass = 0.3 * (1 + draw());
  user.damping = 2 * (1 + draw());
  user.states = states;
  double loss[hand::max_states][hand::max_states] = {};
  for (unsigned i = 0; i < states; ++i) {
    user.input[i] = user.output[i] = 15 * draw();
    for (unsigned j = 0; j <= i; ++j) loss[i][j] = 4 * draw();
  }
  for (unsigned i = 0; i < states; ++i) {
    for (unsigned j = 0; j < states; ++j) {
      for (unsigned k = 0; k < states; ++k) user.dynamics[i][j] -= loss[i][k] * loss[j][k];
    }
  }
  for (unsigned i = 0; i < states; ++i) {
    for (unsigned j = 0; j < i; ++j) {
      const double exchange = 200 * draw();
      user.dynamics[i][j] += exchange;
      user.dynamics[j][i] -= exchange;
    }
  }
  return user;
}

// If this failed, a hand that can push by itself would be taken for a passive one, or the other way round.
TEST(Hand, PassivityIsRecognised) {
  for (const hand& user : {no_hand(), relaxed_hand(), firm_hand(), stiff_grasp()}) EXPECT_TRUE(is_passive(user));
  for (unsigned seed = 0; seed < 100; ++seed) {
    const unsigned states = 1 + seed % hand::max_states;
    hand user = random_passive_hand(seed, states);
    EXPECT_TRUE(is_passive(user)) << "seed " << seed;
    // More negative damping than any of the states can dissipate at every frequency.
    user.damping = -0.01;
    EXPECT_FALSE(is_passive(user)) << "seed " << seed;
  }
  hand growing = mass_spring_damper(0.1, 1, 100);
  growing.dynamics[0][0] = 0.1;
  EXPECT_FALSE(is_passive(growing));
  hand lopsided = mass_spring_damper(0.1, 0, 100);
  lopsided.output[0] *= 1.1;
  EXPECT_FALSE(is_passive(lopsided));
  hand light = no_hand();
  light.mass = -0.1;
  EXPECT_FALSE(is_passive(light));
}

// If this failed, a hand that intends nothing would feed energy into the device, whatever the motor does to it.
TEST(Hand, PassiveHandNeverGivesMoreThanItGot) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    scenario scene;
    scene.user = random_passive_hand(seed, 1 + seed % hand::max_states);
    simulated_device device(plain_device(), scene);
    for (std::uint64_t k = 0; k < 500; ++k) {
      run(device, 1, {4 * draw_uniform(seed, draw_stream::jitter, k / 5) - 2, 0});
      EXPECT_LT(device.ledger().hand, 1e-12 * device.ledger().motor + 1e-15) << "seed " << seed << " sample " << k;
    }
    EXPECT_LT(device.ledger().hand, 0);
  }
}

// If this failed, the figures of the literature would be attached to the wrong letters.
TEST(Hand, SetsOfTheLiteratureHaveTheirValues) {
  const auto is = [](const hand& user, double mass, double damping, double stiffness) {
    EXPECT_EQ(user.mass, mass);
    EXPECT_EQ(user.damping, damping);
    EXPECT_NEAR(user.input[0] * user.output[0], stiffness, 1e-12);
  };
  is(relaxed_hand(), 0.8, 5.5, 30);
  is(firm_hand(), 0.55, 6.5, 135);
  is(stiff_grasp(), 0, 8, 400);
}

// If this failed, a trajectory would jump at its knots, or its velocity would not be its position's slope.
TEST(Trajectory, VelocityIsTheSlopeOfPosition) {
  const double step = 1e-6;
  for (const trajectory& path : {hold_at(0.1), sine(0.3, 2, 0.4, 0.1), through({{0.1, 0}, {0.5, 1}, {0.7, -2}}),
                                 smoothly_through({{0.1, 0}, {0.5, 1}, {0.7, -2}})}) {
    for (double time = 0.0123; time < 1; time += 0.02) {
      const double slope = (path(time + step).position - path(time - step).position) / (2 * step);
      // The third derivative of the fastest of these is below 1e5: step²/6 of it, and the rounding of the difference.
      EXPECT_NEAR(path(time).velocity, slope, 1e5 * step * step / 6 + 1e-15 / step);
    }
  }
  EXPECT_EQ(through({{0.1, 3}, {0.5, 1}})(0).position, 3);
  EXPECT_EQ(through({{0.1, 3}, {0.5, 1}})(0.5).position, 1);
  EXPECT_EQ(smoothly_through({{0.1, 3}, {0.5, 1}})(0.3).position, 2);
}

}  // namespace
}  // namespace dashpot::simulated
