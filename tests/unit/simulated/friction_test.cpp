// Coulomb friction of the simulated plant: stopping, sticking, breaking away.
#include <cmath>

#include <gtest/gtest.h>

#include "plain_device.hpp"

namespace dashpot::simulated {
namespace {

device_description rubbing_device(double friction) {
  device_description device = plain_device();
  device.mechanics.coulomb_friction = friction;
  return device;
}

// If this failed, a sliding tool would stop too early or too late, or would creep or tremble afterwards.
TEST(Friction, StopsWhereItMustAndStaysThereExactly) {
  scenario scene;
  scene.initial_velocity = 0.3;
  simulated_device device(rubbing_device(0.7), scene);
  run(device, 200);
  const double rest = device.truth().position;
  // J v²/2 = f x; events are located to a billionth of a step, where the speed is next to nothing.
  EXPECT_NEAR(rest, 0.2 * 0.3 * 0.3 / 2 / 0.7, 1e-13);
  EXPECT_TRUE(device.truth().stuck);
  run(device, 10000, {0.69, 0});
  EXPECT_EQ(device.truth().position, rest);
  EXPECT_EQ(device.truth().velocity, 0);
  EXPECT_NEAR(device.truth().friction_torque, 0.69, 1e-15);
}

// If this failed, a force just below the friction would move the tool, or one above it would not, or with a wrong
// acceleration.
TEST(Friction, OnlyTheExcessAccelerates) {
  simulated_device held(rubbing_device(0.5));
  run(held, 1000, {-0.5, 0});
  EXPECT_EQ(held.truth().position, 0);
  simulated_device moved(rubbing_device(0.5));
  run(moved, 501, {-0.6, 0});
  EXPECT_NEAR(moved.truth().position, -0.1 / 0.2 * 0.5 * 0.5 / 2, 1e-13);
}

double break_away_error(unsigned substeps) {
  device_description description = rubbing_device(0.5);
  description.motor.amplifier_lag = 0.005;
  scenario scene;
  scene.substeps = substeps;
  simulated_device device(description, scene);
  run(device, 11, {1.2, 0});
  // τ(t) = τ∞ (1 − e^(−t/lag)) passes the friction f at t_b; then J v = ∫(τ − f) dt.
  const double lag = 0.005, end = 0.010, start = -lag * std::log(1 - 0.5 / 1.2);
  const double impulse = (1.2 - 0.5) * (end - start) + 1.2 * lag * (std::exp(-end / lag) - std::exp(-start / lag));
  return std::abs(device.truth().velocity - impulse / 0.2);
}

// If this failed, breaking away would happen at a sample instead of when the force passes the friction.
TEST(Friction, BreaksAwayBetweenSamples) {
  EXPECT_LT(break_away_error(4), 1e-9);
  // Order 4, but the first piece after breaking away has a length of its own.
  EXPECT_NEAR(break_away_error(1) / break_away_error(2), 16, 4);
}

// If this failed, only the first event within a step would be heeded.
TEST(Friction, StopsAndBreaksAwayWithinOneStep) {
  device_description description = rubbing_device(0.5);
  description.loop.sample_period = 0.005;
  description.motor.amplifier_lag = 0.020;
  scenario scene;
  scene.substeps = 1;
  scene.initial_velocity = -0.001;
  simulated_device device(description, scene);
  run(device, 2, {4, 0});
  // It stops within half a millisecond, and breaks away forwards when the rising torque passes the friction.
  const double lag = 0.020, end = 0.005, start = -lag * std::log(1 - 0.5 / 4);
  const double impulse = (4 - 0.5) * (end - start) + 4 * lag * (std::exp(-end / lag) - std::exp(-start / lag));
  EXPECT_NEAR(device.truth().velocity, impulse / 0.2, impulse / 0.2 * std::pow(0.25, 4) / 720);
}

// If this failed, the amplitude of an oscillation under friction would not fall by 2 f/K each half cycle, or it would
// not end stuck.
TEST(Friction, OscillationDecaysInStraightLinesAndSticks) {
  const double stiffness = 500, friction = 0.4, start = 0.01;
  scenario scene;
  scene.user = mass_spring_damper(0, 0, stiffness);
  scene.initial_position = start;
  scene.intended = hold_at(0);
  simulated_device device(rubbing_device(friction), scene);
  run(device, 2000);
  // 10 mm, −8.4, 6.8, −5.2, 3.6, −2.0, 0.4: within f/K = 0.8 mm.
  const double rest = start - 6 * 2 * friction / stiffness;
  EXPECT_NEAR(device.truth().position, rest, 1e-10);
  EXPECT_TRUE(device.truth().stuck);
  double way = 0;
  for (int swing = 0; swing < 6; ++swing) way += 2 * (start - friction / stiffness * (1 + 2 * swing));
  EXPECT_NEAR(device.ledger().friction, friction * way, 1e-12);
}

}  // namespace
}  // namespace dashpot::simulated
