// Obstacles in the way of the simulated tool.
#include <cmath>

#include <gtest/gtest.h>

#include "plain_device.hpp"

namespace dashpot::simulated {
namespace {

// If this failed, a rigid obstacle would be penetrated, rebound, or lose the account of the energy it takes.
TEST(EndStop, RigidObstacleTakesAllMomentum) {
  scenario scene;
  scene.user = mass_spring_damper(0.3, 0, 0);
  scene.initial_velocity = 0.4;
  scene.high = end_stop{0.01};
  simulated_device device(plain_device(), scene);
  run(device, 26);
  EXPECT_NEAR(device.truth().velocity, 0.4, 1e-14);
  run(device, 1000);
  EXPECT_EQ(device.truth().position, 0.01);
  EXPECT_EQ(device.truth().velocity, 0);
  EXPECT_NEAR(device.ledger().stop, 0.5 * 0.4 * 0.4 / 2, 1e-13);
  EXPECT_NEAR(device.ledger().hand, 0.3 * 0.4 * 0.4 / 2, 1e-13);
}

// If this failed, a tool pressed against a rigid obstacle would creep into it, or would stick to it when pulled away.
TEST(EndStop, RigidObstacleHoldsAgainstPushOnly) {
  scenario scene;
  scene.low = end_stop{0};
  simulated_device device(plain_device(), scene);
  run(device, 500, {-3, 0});
  EXPECT_EQ(device.truth().position, 0);
  EXPECT_NEAR(device.truth().friction_torque, -3, 1e-15);
  run(device, 101, {0.2, 0});
  EXPECT_NEAR(device.truth().position, 0.2 / 0.2 * 0.1005 * 0.1005 / 2, 0.001 * 0.1);
  EXPECT_GT(device.truth().position, 0);
  EXPECT_EQ(device.ledger().stop, 0);
}

// If this failed, an elastic obstacle would not give the speed back, or would hold the tool for other than half a
// period.
TEST(EndStop, ElasticObstacleReturnsTheSpeed) {
  scenario scene;
  scene.initial_velocity = 0.5;
  scene.initial_position = -0.0001;
  scene.high = end_stop{0, 2e4, 0};
  simulated_device device(plain_device(), scene);
  run(device, 31);
  EXPECT_NEAR(device.truth().velocity, -0.5, 1e-12);
  EXPECT_NEAR(device.ledger().stop, 0, 1e-13);
  // There 0.2 ms, in contact π√(m/K), back for the rest of 30 ms: the phase error is (ωh)⁴/720 of π at most.
  const double frequency = std::sqrt(2e4 / 0.2), contact = 3.14159265358979323846 / frequency;
  const double error = contact * std::pow(frequency * 0.1 / frequency, 4) / 720;
  EXPECT_NEAR(device.truth().position, -0.5 * (0.030 - 0.0002 - contact), 0.5 * error);
}

// If this failed, a damped obstacle would pull at a tool that leaves it.
TEST(EndStop, DampedObstacleNeverPulls) {
  scenario scene;
  scene.user = relaxed_hand();
  scene.intended = sine(0.03, 2);
  scene.low = end_stop{-0.01, 500, 40};
  simulated_device device(plain_device(), scene);
  double hardest = 0;
  double absorbed = 0;
  for (int k = 0; k < 2000; ++k) {
    run(device, 1);
    EXPECT_LE(device.truth().stop_torque, 1e-9);
    hardest = std::min(hardest, device.truth().stop_torque);
    absorbed = std::max(absorbed, device.ledger().stop);
  }
  EXPECT_LT(hardest, -0.5);
  EXPECT_GT(device.ledger().stop, 0.5 * absorbed);
}

// If this failed, a stop that is reached at the very end of a step would leave a step of no length, and nothing that is
// a number: 1 N for two samples makes 0.01 m/s, which is at 4 mm 400 samples later, 0.1 ps behind the surface.
TEST(EndStop, MayBeReachedAtTheVeryEndOfAStep) {
  scenario scene;
  scene.high = end_stop{0.004 - 1e-15, 1000, 1};
  simulated_device device(plain_device(), scene);
  run(device, 3, {1, 0});
  run(device, 600);
  EXPECT_LT(device.truth().velocity, 0);
  EXPECT_LT(std::abs(device.ledger().imbalance()), 1e-12);
}

}  // namespace
}  // namespace dashpot::simulated
