// The energy ledger of whole runs in which everything happens at once.
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include <dashpot/simulated/draw.hpp>

#include "plain_device.hpp"

namespace dashpot::simulated {
namespace {

// A motor that jerks and a brake that switches, without any sense, from a seed.
actuation senseless_demand(std::uint64_t seed, std::uint64_t k) {
  const double torque = 0.1 * (2 * draw_uniform(seed, draw_stream::jitter, 1000000 + k / 7) - 1);
  const double damping = 0.008 * draw_uniform(seed, draw_stream::jitter, 2000000 + k / 11);
  return {torque, damping};
}

double turnover(const energy_ledger& ledger) {
  return std::abs(ledger.hand) + std::abs(ledger.motor) + ledger.brake + ledger.friction + ledger.damping + ledger.stop;
}

scenario lively_scene(std::uint64_t seed) {
  scenario scene;
  scene.user = seed % 2 ? firm_hand() : relaxed_hand();
  scene.user.release_time = 0.9;
  scene.intended = smoothly_through({{0, 0}, {0.2, 0.03}, {0.5, -0.02}, {0.8, 0.015}});
  scene.low = end_stop{-0.012};
  scene.high = end_stop{0.02, 3000, 4};
  scene.gain = brake_gain::drawn;
  scene.seed = seed;
  return scene;
}

// If this failed, some force would do work that nobody accounts for, or a step across an event would lose energy.
TEST(Ledger, ClosesOverARunWithEverything) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    simulated_device device(imperfect_arm(), lively_scene(seed));
    device_sample sample;
    for (std::uint64_t k = 0; k < 10000; ++k) {
      device.read(sample);
      device.write(senseless_demand(seed, k));
    }
    EXPECT_GT(turnover(device.ledger()), 1e-3);
    EXPECT_LT(std::abs(device.ledger().imbalance()), 1e-9 * turnover(device.ledger())) << "seed " << seed;
  }
}

// If this failed, friction, damping or brake would give energy back.
TEST(Ledger, DissipationNeverFalls) {
  simulated_device device(imperfect_arm(), lively_scene(3));
  device_sample sample;
  energy_ledger before;
  for (std::uint64_t k = 0; k < 10000; ++k) {
    device.read(sample);
    device.write(senseless_demand(3, k));
    EXPECT_GE(device.ledger().brake, before.brake);
    EXPECT_GE(device.ledger().friction, before.friction);
    EXPECT_GE(device.ledger().damping, before.damping);
    before = device.ledger();
  }
}

// If this failed, an entry would bear the name of another force: each is integrated here once more from what the device
// shows.
TEST(Ledger, EntriesAreTheWorkOfTheirForces) {
  device_description arm = imperfect_arm();
  arm.loop.jitter = 0;
  // Without lags the actuators are constant between samples, so that only the motion has to be integrated.
  arm.motor.amplifier_lag = 0;
  arm.brake.coil_lag = 0;
  arm.brake.slew = 0;
  scenario scene = lively_scene(1);
  scene.low.reset();
  simulated_device device(arm, scene);
  device_sample sample;
  energy_ledger sum;
  plant_view before = device.truth();
  for (std::uint64_t k = 0; k < 8000; ++k) {
    device.read(sample);
    const plant_view after = device.truth();
    const double moved = after.position - before.position;
    const double speed_squared = (before.velocity * before.velocity + after.velocity * after.velocity) / 2;
    const double period = after.time - before.time;
    sum.motor += after.motor_torque * moved;
    sum.brake += after.brake_damping * speed_squared * period;
    sum.damping += arm.mechanics.damping * speed_squared * period;
    sum.friction += arm.mechanics.coulomb_friction * std::abs(moved);
    sum.stop += (before.stop_torque + after.stop_torque) / 2 * moved;
    before = after;
    device.write({0.05 * std::sin(0.002 * static_cast<double>(k)), 4e-3});
  }
  const energy_ledger& ledger = device.ledger();
  // The trapezoidal rule at 10 kHz: 1 % is far above its error and far below any mix-up of two forces.
  EXPECT_NEAR(ledger.motor, sum.motor, 0.01 * std::abs(sum.motor));
  EXPECT_NEAR(ledger.brake, sum.brake, 0.01 * sum.brake);
  EXPECT_NEAR(ledger.damping, sum.damping, 0.01 * sum.damping);
  EXPECT_NEAR(ledger.friction, sum.friction, 0.01 * sum.friction);
  EXPECT_NEAR(ledger.stop, sum.stop, 0.01 * sum.stop);
  EXPECT_GT(sum.stop, 1e-5);
}

}  // namespace
}  // namespace dashpot::simulated
