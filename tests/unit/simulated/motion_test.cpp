// Smooth motions of the simulated plant against their closed forms: by the order of convergence, and in size.
#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "plain_device.hpp"

namespace dashpot::simulated {
namespace {

// Halving the step of a method of order 4 divides its error by 16, and by little else at steps this short.
void expect_order_four(double error, double error_at_half_step) { EXPECT_NEAR(error / error_at_half_step, 16, 0.5); }

double oscillation_error(unsigned substeps) {
  scenario scene;
  scene.user = mass_spring_damper(0.3, 2, 500);
  scene.initial_position = 0.01;
  scene.intended = hold_at(0.002);
  scene.substeps = substeps;
  device_description description = plain_device();
  description.mechanics.damping = 1;
  description.loop.sample_period = 0.004;
  simulated_device device(description, scene);
  run(device, 101);
  const double mass = 0.5, damping = 3, stiffness = 500, time = 100 * 0.004, start = 0.008;
  const double rate = damping / (2 * mass);
  const double frequency = std::sqrt(stiffness / mass - rate * rate);
  const double expected = 0.002 + start * std::exp(-rate * time) *
                                      (std::cos(frequency * time) + rate / frequency * std::sin(frequency * time));
  return std::abs(device.truth().position - expected);
}

// If this failed, a free oscillation of tool and hand would have a wrong frequency, damping or rest position.
TEST(Motion, FreeOscillationConvergesToItsClosedForm) {
  expect_order_four(oscillation_error(2), oscillation_error(4));
  // Of its own accord the plant takes two steps a period; each turns the phase by (ωh)⁵/720 too little or too much.
  const double frequency = std::sqrt(1000 - 9.0), step = 0.002;
  EXPECT_LT(oscillation_error(0), 0.008 * frequency * 0.4 * std::pow(frequency * step, 4) / 720);
}

double brake_decay_error(unsigned substeps) {
  scenario scene;
  scene.initial_velocity = 0.5;
  scene.substeps = substeps;
  simulated_device device(plain_device(), scene);
  run(device, 21, {0, 20});
  const double expected = 0.5 * 0.2 / 20 * (1 - std::exp(-20 / 0.2 * 0.020));
  return std::abs(device.truth().position - expected);
}

// If this failed, a braked tool would not coast v J/b further, or not at the right pace.
TEST(Motion, BrakeDecayConvergesToItsClosedForm) {
  expect_order_four(brake_decay_error(1), brake_decay_error(2));
  scenario scene;
  scene.initial_velocity = 0.5;
  simulated_device device(plain_device(), scene);
  run(device, 1001, {0, 20});
  EXPECT_NEAR(device.truth().position, 0.5 * 0.2 / 20, 1e-9);
  EXPECT_NEAR(device.ledger().brake, 0.2 * 0.5 * 0.5 / 2, 1e-12);
}

double maxwell_hand_error(unsigned substeps, double stiffness = 300, double viscosity = 4, unsigned periods = 50) {
  const double mass = 0.2, speed = 0.3;
  scenario scene;
  scene.user.states = 1;
  scene.user.dynamics[0][0] = -stiffness / viscosity;
  scene.user.input[0] = scene.user.output[0] = std::sqrt(stiffness);
  scene.initial_velocity = speed;
  scene.substeps = substeps;
  simulated_device device(plain_device(), scene);
  run(device, periods + 1);
  // m v̇ = −f, ḟ = K v − (K/B) f: v = Re{…} over the roots of s² + (K/B) s + K/m.
  const std::complex<double> half = stiffness / viscosity / 2;
  const std::complex<double> root = std::sqrt(half * half - stiffness / mass);
  const std::complex<double> fast = -half - root, slow = -half + root;
  const double time = 0.001 * periods;
  // v(0) = speed, v̇(0) = 0.
  const std::complex<double> velocity =
      speed * (fast * std::exp(slow * time) - slow * std::exp(fast * time)) / (fast - slow);
  return std::abs(device.truth().velocity - velocity.real());
}

// If this failed, a hand with inner states, here a spring and a damper in series, would act as something else.
TEST(Motion, HandWithItsOwnStateConvergesToItsClosedForm) {
  expect_order_four(maxwell_hand_error(1), maxwell_hand_error(2));
  EXPECT_LT(maxwell_hand_error(0), 1e-7);
}

// If this failed, the hand's mass, a constant motor torque or the arm radius would enter with a wrong factor.
TEST(Motion, ConstantTorqueAcceleratesJointAndHandTogether) {
  device_description arm = plain_device();
  arm.motion = motion::rotation;
  arm.arm_radius = 0.05;
  arm.mechanics.inertia = 1e-3;
  scenario scene;
  scene.user = mass_spring_damper(0.4, 0, 0);
  simulated_device device(arm, scene);
  run(device, 201, {0.01, 0});
  const double inertia = 1e-3 + 0.4 * 0.05 * 0.05, time = 0.2;
  // A quadratic motion is exact at any step; what is left is the rounding of some hundred steps.
  EXPECT_NEAR(device.truth().position, 0.01 / inertia * time * time / 2, 1e-13);
  EXPECT_NEAR(device.truth().velocity, 0.01 / inertia * time, 1e-12);
  EXPECT_NEAR(device.truth().hand_torque, -0.4 * 0.05 * 0.05 * 0.01 / inertia, 1e-15);
}

// If this failed, what the hand and the stops are would depend on whether an arm lies between them and the joint.
TEST(Motion, ArmMakesNoDifferenceAtTheTool) {
  scenario scene;
  scene.user = mass_spring_damper(0.3, 4, 200);
  scene.user.dynamics[0][0] = -20;
  scene.intended = sine(0.02, 2);
  scene.initial_position = 0.003;
  scene.initial_velocity = 0.05;
  scene.high = end_stop{0.012};
  scene.low = end_stop{-0.01, 3000, 5};
  device_description linear = plain_device();
  device_description rotary = linear;
  rotary.motion = motion::rotation;
  rotary.arm_radius = 0.05;
  rotary.mechanics.inertia *= 0.05 * 0.05;
  rotary.brake.max_damping *= 0.05 * 0.05;
  simulated_device tool(linear, scene), joint(rotary, scene);
  for (int k = 0; k < 1500; ++k) {
    run(tool, 1);
    run(joint, 1);
    // Events are located to a billionth of a step; the rest is rounding.
    ASSERT_NEAR(joint.truth().position * 0.05, tool.truth().position, 1e-12) << k;
  }
  EXPECT_GT(tool.ledger().stop, 1e-5);
  EXPECT_NEAR(joint.ledger().stop, tool.ledger().stop, 1e-9);
  EXPECT_NEAR(joint.ledger().hand, tool.ledger().hand, 1e-9);
}

// If this failed, a hand driven along a sine would follow it with a wrong amplitude or phase.
TEST(Motion, DrivenHandFollowsItsFrequencyResponse) {
  const double frequency = 3, rate = 2 * 3.14159265358979323846 * frequency;
  scenario scene;
  scene.user = firm_hand();
  scene.intended = sine(0.01, frequency);
  simulated_device device(plain_device(), scene);
  run(device, 4001);
  const std::complex<double> s(0, rate);
  const std::complex<double> response = (135.0 + 6.5 * s) / (135.0 + 6.5 * s + 0.75 * s * s);
  const std::complex<double> expected = 0.01 * response * std::exp(s * 4.0);
  // After 4 s the transient has decayed by e^(−6.5/1.5 · 4).
  EXPECT_NEAR(device.truth().position, expected.imag(), 0.02 * std::exp(-6.5 / 1.5 * 4));
}

// If this failed, an intention would reach the hand's inner states late, twice, or not at all.
TEST(Motion, DrivenHandWithItsOwnStateFollowsItsFrequencyResponse) {
  const double frequency = 3, rate = 2 * 3.14159265358979323846 * frequency, stiffness = 300, viscosity = 4;
  scenario scene;
  scene.user = mass_spring_damper(0.1, 2, stiffness);
  scene.user.dynamics[0][0] = -stiffness / viscosity;
  scene.intended = sine(0.01, frequency);
  simulated_device device(plain_device(), scene);
  run(device, 4001);
  const std::complex<double> s(0, rate);
  // A damper beside a spring and a damper in series, and 0.3 kg.
  const std::complex<double> impedance = 2.0 + stiffness / (s + stiffness / viscosity);
  const std::complex<double> response = 0.01 * impedance / (impedance + 0.3 * s);
  const std::complex<double> speed_now = response * s * std::exp(s * 4.0);
  // The transients have decayed by e^(−20·4); the steps turn the phase by (ωh)⁴/720 of ωt, with h at most 1 ms.
  EXPECT_NEAR(device.truth().velocity, speed_now.imag(), 0.01 * rate * rate * 4 * std::pow(rate * 0.001, 4) / 720);
}

// What half a time constant is wrong by, of what happens within it: the steps are no longer.
const double step_error = std::pow(0.5, 4) / 720;

// If this failed, an amplifier's lag much shorter than the period would be stepped over.
TEST(Motion, StepsAreShortAgainstTheAmplifier) {
  device_description description = plain_device();
  description.motor.amplifier_lag = 0.00005;
  simulated_device device(description);
  run(device, 2, {0.4, 0});
  // From rest: v = a (t − lag (1 − e^(−t/lag))).
  const double lag = 0.00005, time = 0.001, acceleration = 2;
  const double expected = acceleration * (time - lag * (1 - std::exp(-time / lag)));
  EXPECT_NEAR(device.truth().velocity, expected, acceleration * lag * step_error);
}

// If this failed, a coil's lag much shorter than the period would be stepped over.
TEST(Motion, StepsAreShortAgainstTheCoil) {
  const double lag = 0.00005, time = 0.001;
  device_description description = plain_device();
  description.brake.coil_lag = lag;
  scenario scene;
  scene.initial_velocity = 0.5;
  simulated_device device(description, scene);
  run(device, 2, {0, 60});
  // ln v falls by the integral of b/m = 300/s · (1 − e^(−t/lag))².
  const double left = std::exp(-time / lag);
  const double fall = 300 * (time - 2 * lag * (1 - left) + lag / 2 * (1 - left * left));
  EXPECT_NEAR(std::log(0.5 / device.truth().velocity), fall, 300 * lag * step_error);
}

// If this failed, a brake that stops the tool within a period would be stepped over.
TEST(Motion, StepsAreShortAgainstTheBrake) {
  device_description description = plain_device();
  description.brake.max_damping = 1000;
  scenario scene;
  scene.initial_velocity = 0.5;
  simulated_device device(description, scene);
  run(device, 2, {0, 1000});
  const double way = 0.5 * 0.2 / 1000;
  EXPECT_NEAR(device.truth().position, way * (1 - std::exp(-1000 / 0.2 * 0.001)), way * step_error);
}

// If this failed, a hand whose inner states are much faster than the period would be stepped over.
TEST(Motion, StepsAreShortAgainstTheHand) {
  const double stiffness = 2000, viscosity = 0.1, rate = stiffness / viscosity;
  const double way_lost = viscosity / 0.2 / rate;  // of the velocity, while the hand's force builds up
  EXPECT_LT(maxwell_hand_error(0, stiffness, viscosity, 1), 0.3 * way_lost * step_error);
}

// If this failed, a simulation that runs away would come back as a small number.
TEST(Motion, RunawayStaysARunaway) {
  device_description description = plain_device();
  description.encoder.step = 1e-6;
  simulated_device device(description);
  const device_sample sample = run(device, 100, {1e300, 0});
  EXPECT_GT(sample.position, 1e290);
}

// If this failed, a hand that has let go would still push, or would take its speed away from the tool, or let go too
// early or late.
TEST(Motion, ReleasedToolGoesOnAlone) {
  scenario scene;
  scene.user = mass_spring_damper(0.5, 8, 0);
  scene.user.release_time = 0.0505;
  scene.intended = through({{0, 0}, {1, 0.1}});
  simulated_device device(plain_device(), scene);
  run(device, 52);
  // m v̇ = D (v_d − v) until then; at steps of half a millisecond of a time constant of 87 ms.
  const double speed = device.truth().velocity;
  const double work = device.ledger().hand;
  EXPECT_NEAR(speed, 0.1 * (1 - std::exp(-8 / 0.7 * 0.0505)), 0.1 * std::pow(8 / 0.7 * 0.001, 4) / 720);
  EXPECT_NEAR(work, 0.2 * speed * speed / 2, 1e-17);
  run(device, 100);
  EXPECT_EQ(device.truth().hand_torque, 0);
  EXPECT_NEAR(device.truth().velocity, speed, 1e-14);
  EXPECT_EQ(device.ledger().hand, work);
}

// If this failed, a hand that lets go at a sample would hold on for one more period.
TEST(Motion, ReleaseAtASampleIsNotLate) {
  scenario scene;
  scene.user = stiff_grasp();
  scene.user.release_time = 0.05;
  scene.intended = through({{0, 0}, {1, 0.1}});
  simulated_device device(plain_device(), scene);
  run(device, 51);
  const double speed = device.truth().velocity;
  run(device, 1);
  EXPECT_NEAR(device.truth().velocity, speed, 1e-15);
}

// If this failed, a tool that is led along a prescribed motion would be elsewhere, or the work of leading it would be
// miscounted.
TEST(Motion, PrescribedMotionAccountsForItsWork) {
  scenario scene;
  scene.intended = sine(0.02, 1);
  scene.prescribed = true;
  simulated_device device(plain_device(), scene);
  run(device, 1001, {0, 5});
  const double rate = 2 * 3.14159265358979323846;
  EXPECT_NEAR(device.truth().position, 0, 1e-15);
  EXPECT_NEAR(device.truth().velocity, 0.02 * rate, 1e-12);
  // Over one cycle: b ∫v² dt = b (A ω)² T/2.
  EXPECT_NEAR(device.ledger().hand, 5 * (0.02 * rate) * (0.02 * rate) / 2, 1e-12);
}

}  // namespace
}  // namespace dashpot::simulated
