// A structure that gives, its backlash, and an amplifier that adds noise, against their closed forms.
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <dashpot/simulated/draw.hpp>

#include "plain_device.hpp"

namespace dashpot::simulated {
namespace {

constexpr double pi = 3.14159265358979323846;

// 0.2 kg, of which 50 g at the tool swing against the rest at 40 Hz.
device_description giving_device() {
  device_description device = plain_device();
  device.mechanics.mode = {40, 0.05, 0.05};
  return device;
}

// k of the mode's spring: μ ω².
double stiffness_of(const mechanics_description& m) {
  const double omega = 2 * pi * m.mode.frequency;
  return m.mode.mass * (m.inertia - m.mode.mass) / m.inertia * omega * omega;
}

// Under a constant force F on the shaft the two sides swing by x = y − q about −F/(J_s ω²):
//     x = −F/(J_s ω²) (1 − e^{−ζωt} (cos ω_d t + ζω/ω_d sin ω_d t)).
double swing_error(unsigned substeps) {
  scenario scene;
  scene.substeps = substeps;
  const device_description description = giving_device();
  simulated_device device(description, scene);
  run(device, 31, {3, 0});
  const structural_mode& mode = description.mechanics.mode;
  const double omega = 2 * pi * mode.frequency, rate = mode.damping_ratio * omega, time = 0.030;
  const double damped = std::sqrt(omega * omega - rate * rate);
  const double rest = -3 / ((description.mechanics.inertia - mode.mass) * omega * omega);
  const double expected =
      rest * (1 - std::exp(-rate * time) * (std::cos(damped * time) + rate / damped * std::sin(damped * time)));
  return std::abs(device.truth().tool_position - device.truth().position - expected);
}

// If this failed, the mode would have another frequency, damping or deflection than the file states.
TEST(Mode, SwingsAsItsClosedForm) {
  const device_description description = giving_device();
  const double omega = 2 * pi * description.mechanics.mode.frequency, size = 3 / (0.15 * omega * omega);
  EXPECT_NEAR(swing_error(2) / swing_error(4), 16, 0.5);  // order 4
  // Left to itself the plant turns the phase by (ωh)⁵/720 a step too little or too much; its step is a 10th of 1/ω.
  EXPECT_LT(swing_error(0), size * omega * 0.030 * std::pow(0.1, 4) / 720);
}

// If this failed, the centre of mass would be moved by the structure's own force.
TEST(Mode, MovesItsCentreOfMassByTheMotorAlone) {
  simulated_device device(giving_device());
  run(device, 101, {3, 0});
  const plant_view now = device.truth();
  EXPECT_NEAR((0.15 * now.velocity + 0.05 * now.tool_velocity) / 0.2, 3 / 0.2 * 0.100, 1e-12);
}

// If this failed, a device whose structure hardly gives would move otherwise than a rigid one: the deflection falls as
// 1/f².
TEST(Mode, IsRigidInTheLimit) {
  const auto position_with = [](double frequency) {
    device_description description = giving_device();
    description.mechanics.mode.frequency = frequency;
    description.mechanics.mode.damping_ratio = 1;
    scenario scene;
    scene.user = firm_hand();
    scene.intended = smoothly_through({{0, 0}, {0.1, 0.01}});
    simulated_device device(description, scene);
    run(device, 101);
    return device.truth().tool_position;
  };
  device_description rigid = plain_device();
  scenario scene;
  scene.user = firm_hand();
  scene.intended = smoothly_through({{0, 0}, {0.1, 0.01}});
  simulated_device device(rigid, scene);
  run(device, 101);
  const double off = position_with(200) - device.truth().position, less = position_with(400) - device.truth().position;
  EXPECT_GT(std::abs(off), 1e-9);
  EXPECT_NEAR(off / less, 4, 0.4);
}

// If this failed, within its backlash g the shaft would not be free, or g not be as wide as stated. The tool is held by
// a spring K and the motor pushes with F, then −F: the shaft rests at ±(g/2 + F/k + F/K).
TEST(Backlash, LeavesTheShaftFreeOverItsWidth) {
  device_description description = giving_device();
  description.mechanics.damping = 20;
  description.mechanics.backlash = 0.002;
  scenario scene;
  scene.user = mass_spring_damper(0, 20, 800);
  simulated_device device(description, scene);
  const double give = 1 / stiffness_of(description.mechanics) + 1 / 800.0;
  run(device, 4000, {0.5, 0});
  EXPECT_NEAR(device.truth().position, 0.001 + 0.5 * give, 1e-9);
  run(device, 4000, {-0.5, 0});
  EXPECT_NEAR(device.truth().position, -0.001 - 0.5 * give, 1e-9);
  EXPECT_NEAR(device.truth().tool_position, -0.5 / 800, 1e-9);
}

// If this failed, the structure would pull within its backlash, or across it: a tool that flies between its sides keeps
// its speed.
TEST(Backlash, DoesNotPull) {
  device_description description = giving_device();
  description.mechanics.backlash = 0.01;
  simulated_device device(description);
  run(device, 3, {1, 0});  // 1 N for two samples, 1/0.15 N/kg
  run(device, 100);
  EXPECT_EQ(device.truth().tool_velocity, 0);
  EXPECT_NEAR(device.truth().velocity, 1 / 0.15 * 0.002, 1e-9);
}

// If this failed, at the end of an impact the structure would pull. In contact x'' + 2ζω x' + ω² x = 0 from x = 0, x' =
// v; the push k x + c x' is gone at ω_d t = π − 2 asin ζ, before x is 0 again, and the two part with what x' is then.
TEST(Backlash, PartsWhenThePushIsGone) {
  device_description description = giving_device();
  description.mechanics.backlash = 0.01;
  description.mechanics.mode.damping_ratio = 0.3;
  simulated_device device(description);
  run(device, 3, {1, 0});
  run(device, 600);
  const double omega = 2 * pi * 40, zeta = 0.3, damped = omega * std::sqrt(1 - zeta * zeta);
  const double angle = pi - 2 * std::asin(zeta), decay = std::exp(-zeta * omega * angle / damped);
  const double restitution = -decay * (std::cos(angle) - zeta * omega / damped * std::sin(angle));
  const double before = 1 / 0.15 * 0.002;
  EXPECT_NEAR((device.truth().tool_velocity - device.truth().velocity) / before, restitution, 1e-5);
}

double turnover_with_mode(const energy_ledger& ledger) {
  return std::abs(ledger.hand) + std::abs(ledger.motor) + ledger.brake + ledger.friction + ledger.damping +
         std::abs(ledger.stop) + std::abs(ledger.mode);
}

scenario soft_lively_scene(std::uint64_t seed) {
  scenario scene;
  scene.user = seed % 2 ? firm_hand() : stiff_grasp();
  scene.user.release_time = 0.9;
  scene.intended = smoothly_through({{0, 0}, {0.2, 0.03}, {0.5, -0.02}, {0.8, 0.015}});
  scene.low = end_stop{-0.012, 2000, 1};
  scene.high = end_stop{0.02, 3000, 4};
  scene.gain = brake_gain::drawn;
  scene.seed = seed;
  return scene;
}

device_description everything_that_gives(std::uint64_t seed) {
  device_description arm = imperfect_arm();
  arm.mechanics.mode = {seed % 3 ? 180.0 : 900.0, seed % 2 ? 0.0 : 0.02, 1e-5};
  arm.mechanics.backlash = seed % 4 ? 2e-3 : 0;
  arm.motor.noise = 2e-3;
  return arm;
}

actuation restless_demand(std::uint64_t seed, std::uint64_t k) {
  return {0.1 * (2 * draw_uniform(seed, draw_stream::jitter, 1000000 + k / 7) - 1),
          0.008 * draw_uniform(seed, draw_stream::jitter, 2000000 + k / 11)};
}

// If this failed, some force of the structure would do work that nobody accounts for, or an engagement would gain or
// lose energy.
TEST(Mode, LedgerClosesWithEverything) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    simulated_device device(everything_that_gives(seed), soft_lively_scene(seed));
    device_sample sample;
    for (std::uint64_t k = 0; k < 10000; ++k) {
      device.read(sample);
      device.write(restless_demand(seed, k));
    }
    EXPECT_GT(turnover_with_mode(device.ledger()), 1e-3);
    EXPECT_LT(std::abs(device.ledger().imbalance()), 1e-9 * turnover_with_mode(device.ledger())) << "seed " << seed;
  }
}

// If this failed, spring, damper and backlash would give more than they took: they start relaxed, and what they hold is
// not negative.
TEST(Mode, NeverGivesMoreThanItTook) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    simulated_device device(everything_that_gives(seed), soft_lively_scene(seed));
    device_sample sample;
    for (std::uint64_t k = 0; k < 10000; ++k) {
      device.read(sample);
      device.write(restless_demand(seed, k));
      ASSERT_GE(device.ledger().mode, -1e-9 * turnover_with_mode(device.ledger()))
          << "seed " << seed << ", sample " << k;
    }
  }
}

// If this failed, the encoder would see the tool: it is the shaft's.
TEST(Mode, EncoderIsOnTheShaft) {
  simulated_device device(giving_device());
  const device_sample sample = run(device, 21, {3, 0});
  EXPECT_EQ(sample.position, device.truth().position);
  EXPECT_NE(sample.position, device.truth().tool_position);
}

std::vector<double> torques(double noise, std::uint64_t seed, unsigned samples) {
  device_description description = plain_device();
  description.motor.noise = noise;
  scenario scene;
  scene.seed = seed;
  simulated_device device(description, scene);
  std::vector<double> all;
  for (unsigned k = 0; k < samples; ++k) all.push_back((run(device, 1, {0.5, 0}), device.truth().motor_torque));
  all.erase(all.begin());  // before the first command
  return all;
}

// If this failed, the amplifier's noise would have another size than stated, a mean, or a memory. Of N samples the rms
// is off by rms/√(2N), mean and correlation by 1/√N of it: four of these.
TEST(MotorNoise, IsWhiteAndOfTheStatedSize) {
  constexpr unsigned samples = 20001;
  const double noise = 0.03, n = samples - 1;
  double mean = 0, power = 0, correlation = 0, before = 0;
  for (const double torque : torques(noise, 7, samples)) {
    const double added = torque - 0.5;
    mean += added / n;
    power += added * added / n;
    correlation += added * before / n;
    before = added;
  }
  EXPECT_NEAR(mean, 0, 4 * noise / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(power), noise, 4 * noise / std::sqrt(2 * n));
  EXPECT_NEAR(correlation, 0, 4 * noise * noise / std::sqrt(n));
}

// If this failed, the same seed would give another run, or another seed the same.
TEST(MotorNoise, DependsOnItsSeedAlone) {
  EXPECT_EQ(torques(0.03, 7, 100), torques(0.03, 7, 100));
  EXPECT_NE(torques(0.03, 7, 100), torques(0.03, 8, 100));
  EXPECT_EQ(torques(0, 7, 100), torques(0, 8, 100));
}

// If this failed, what the structure makes impossible to simulate would be simulated as something else.
TEST(Mode, RefusesWhatItDoesNotSimulate) {
  const device_description device = giving_device();
  scenario rigid, prescribed;
  rigid.high = end_stop{0.01};
  prescribed.prescribed = true;
  prescribed.intended = hold_at(0);
  device_description heavy = device, loose = plain_device();
  heavy.mechanics.mode.mass = 0.2;
  loose.mechanics.backlash = 1e-3;
  EXPECT_EQ(simulated_device::refusal(device, {}), nullptr);
  for (const char* reason : {simulated_device::refusal(device, rigid), simulated_device::refusal(device, prescribed),
                             simulated_device::refusal(heavy, {}), simulated_device::refusal(loose, {})})
    EXPECT_NE(reason, nullptr);
}

}  // namespace
}  // namespace dashpot::simulated
