// Smooth motions of the simulated plant against their closed forms: by the order of convergence, and in size.
#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "plain_device.hpp"

namespace dashpot::simulated {
namespace {

// Halving the step of a method of order 4 divides its error by 16, and by little else at steps this short.
void expect_order_four(double error, double error_at_half_step) {
  EXPECT_NEAR(error / error_at_half_step, 16, 0.5);
}

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

// A free oscillation of tool and hand would have a wrong frequency, damping or rest position.
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

// A braked tool would not coast v J/b further, or not at the right pace.
TEST(Motion, BrakeDecayConvergesToItsClosedForm) {
  expect_order_four(brake_decay_error(1), brake_decay_error(2));
  scenario scene;
  scene.initial_velocity = 0.5;
  simulated_device device(plain_device(), scene);
  run(device, 1001, {0, 20});
  EXPECT_NEAR(device.truth().position, 0.5 * 0.2 / 20, 1e-9);
  EXPECT_NEAR(device.ledger().brake, 0.2 * 0.5 * 0.5 / 2, 1e-12);
}

double maxwell_hand_error(unsigned substeps) {
  const double stiffness = 300, viscosity = 4, mass = 0.2, speed = 0.3;
  scenario scene;
  scene.user.states = 1;
  scene.user.dynamics[0][0] = -stiffness / viscosity;
  scene.user.input[0] = scene.user.output[0] = std::sqrt(stiffness);
  scene.initial_velocity = speed;
  scene.substeps = substeps;
  simulated_device device(plain_device(), scene);
  run(device, 51);
  // m v̇ = −f, ḟ = K v − (K/B) f: v = Re{…} over the roots of s² + (K/B) s + K/m.
  const std::complex<double> half = stiffness / viscosity / 2;
  const std::complex<double> root = std::sqrt(half * half - stiffness / mass);
  const std::complex<double> fast = -half - root, slow = -half + root;
  const double time = 0.050;
  // v(0) = speed, v̇(0) = 0.
  const std::complex<double> velocity =
      speed * (fast * std::exp(slow * time) - slow * std::exp(fast * time)) / (fast - slow);
  return std::abs(device.truth().velocity - velocity.real());
}

// A hand with inner states, here a spring and a damper in series, would act as something else.
TEST(Motion, HandWithItsOwnStateConvergesToItsClosedForm) {
  expect_order_four(maxwell_hand_error(1), maxwell_hand_error(2));
  EXPECT_LT(maxwell_hand_error(0), 1e-7);
}

// The hand's mass, a constant motor torque or the arm radius would enter with a wrong factor.
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
}

// A hand driven along a sine would follow it with a wrong amplitude or phase.
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

// A lag much shorter than the period would be stepped over.
TEST(Motion, StepsAreShortAgainstTheActuators) {
  device_description description = plain_device();
  description.motor.amplifier_lag = 0.00005;
  simulated_device device(description);
  run(device, 2, {0.4, 0});
  // From rest: v = a (t − lag (1 − e^(−t/lag))). A step of half a lag is wrong by (½)⁴/4320 of what the lag costs.
  const double lag = 0.00005, time = 0.001, acceleration = 2;
  const double expected = acceleration * (time - lag * (1 - std::exp(-time / lag)));
  EXPECT_NEAR(device.truth().velocity, expected, acceleration * lag * std::pow(0.5, 4) / 4320);
}

// A simulation that runs away would come back as a small number.
TEST(Motion, RunawayStaysARunaway) {
  device_description description = plain_device();
  description.encoder.step = 1e-6;
  simulated_device device(description);
  const device_sample sample = run(device, 100, {1e300, 0});
  EXPECT_GT(sample.position, 1e290);
}

// A hand that has let go would still push, or would take its speed away from the tool.
TEST(Motion, ReleasedToolGoesOnAlone) {
  scenario scene;
  scene.user = stiff_grasp();
  scene.user.mass = 0.5;
  scene.user.release_time = 0.0505;
  scene.intended = through({{0, 0}, {1, 0.1}});
  simulated_device device(plain_device(), scene);
  run(device, 52);
  const double speed = device.truth().velocity;
  const double work = device.ledger().hand;
  EXPECT_GT(speed, 0.02);
  run(device, 100);
  EXPECT_EQ(device.truth().hand_torque, 0);
  EXPECT_NEAR(device.truth().velocity, speed, 1e-14);
  EXPECT_EQ(device.ledger().hand, work);
}

// A tool that is led along a prescribed motion would be elsewhere, or the work of leading it would be miscounted.
TEST(Motion, PrescribedMotionIsFollowedAndPaidFor) {
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
