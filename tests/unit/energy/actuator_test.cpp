// From commands at the tool to torque, damping and currents at the joint.
#include <cmath>

#include <gtest/gtest.h>

#include <dashpot/actuator.hpp>

namespace dashpot {
namespace {

// The paper's arm, with a coil that follows at once.
device_description arm() {
  device_description device;
  device.motion = motion::rotation;
  device.arm_radius = 0.05;
  device.loop.sample_period = 0.001;
  device.motor.max_torque = 0.08;
  device.motor.torque_constant = 0.02;
  device.brake.kind = brake_kind::eddy_current;
  device.brake.max_damping = 7e-3;
  device.brake.damping_per_current_squared = 1.75e-3;
  return device;
}

// A rounding of a handful of products.
void expect_equal(double seen, double expected) { EXPECT_NEAR(seen, expected, 4e-16 * std::abs(expected)); }

// If this failed, the arm radius would enter with a wrong power, or the torque with a wrong sign.
TEST(Actuator, ConvertsFromToolToJoint) {
  actuator<double> drive(arm(), motion::translation);
  const actuator_output<double> output = drive.drive({2, 0.6}, 0);
  expect_equal(output.motor_torque, -0.6 * 0.05);
  expect_equal(output.brake_damping, 2 * 0.05 * 0.05);
  expect_equal(output.applied_force, 0.6);
  expect_equal(output.demand().motor_torque, -0.03);
  expect_equal(output.demand().brake_damping, 0.005);
  EXPECT_FALSE(output.motor_saturated());
  EXPECT_EQ(output.damping_clipped, 0);
  expect_equal(drive.gear().tool_motion(0.3), 0.015);
  expect_equal(drive.gear().joint_motion(0.015), 0.3);
}

// If this failed, a network in the joint's own coordinate would be scaled by the arm.
TEST(Actuator, LeavesJointNetworksAlone) {
  actuator<double> drive(arm(), motion::rotation);
  const actuator_output<double> output = drive.drive({0.004, 0.02}, 0);
  EXPECT_EQ(output.motor_torque, -0.02);
  EXPECT_EQ(output.brake_damping, 0.004);
  EXPECT_EQ(drive.gear().tool_motion(0.3), 0.3);
}

// If this failed, a linear device would be asked to render a rotation, or a rotary one without an arm a translation.
TEST(Actuator, KnowsWhatItCanDrive) {
  device_description device = arm();
  EXPECT_TRUE(can_drive(device, motion::translation));
  EXPECT_TRUE(can_drive(device, motion::rotation));
  device.arm_radius = 0;
  EXPECT_FALSE(can_drive(device, motion::translation));
  device.motion = motion::translation;
  device.arm_radius = 0.05;
  EXPECT_TRUE(can_drive(device, motion::translation));
  EXPECT_FALSE(can_drive(device, motion::rotation));
}

// If this failed, currents would not be i = √(b/κ) and τ/k_t, or would be invented where the constants are not stated.
TEST(Actuator, StatesTheCurrents) {
  device_description device = arm();
  const actuator_output<double> output = actuator<double>(device, motion::rotation).drive({7e-3, 0.03}, 0);
  expect_equal(output.coil_current, 2);
  expect_equal(output.motor_current, -1.5);
  device.motor.torque_constant = 0;
  device.brake.damping_per_current_squared = 0;
  const actuator_output<double> unknown = actuator<double>(device, motion::rotation).drive({7e-3, 0.03}, 0);
  EXPECT_EQ(unknown.coil_current, 0);
  EXPECT_EQ(unknown.motor_current, 0);
  EXPECT_EQ(unknown.brake_damping, 7e-3);
}

// If this failed, a limit would be exceeded, or what it takes away would not be told to the safety monitor.
TEST(Actuator, CutsAndReports) {
  actuator<double> drive(arm(), motion::rotation);
  const actuator_output<double> output = drive.drive({0.010, -0.2}, 0);
  EXPECT_EQ(output.motor_torque, 0.08);
  expect_equal(output.torque_clipped, 0.12);
  EXPECT_EQ(output.applied_force, -0.08);
  EXPECT_TRUE(output.motor_saturated());
  EXPECT_EQ(output.brake_damping, 7e-3);
  expect_equal(output.damping_clipped, 0.003);
  const actuator_output<double> negative = drive.drive({-0.001, 0}, 0);
  EXPECT_EQ(negative.brake_damping, 0);
  EXPECT_EQ(negative.damping_clipped, -0.001);
}

// If this failed, a device without a brake would be asked to brake, or one without a stated torque limit would be cut
// to nothing.
TEST(Actuator, AbsentPartsAreAbsent) {
  device_description device;
  device.brake.max_damping = 3;
  actuator<double> drive(device, motion::translation);
  const actuator_output<double> output = drive.drive({2, 1e6}, 0);
  EXPECT_EQ(output.brake_damping, 0);
  EXPECT_EQ(output.damping_clipped, 2);
  EXPECT_EQ(output.motor_torque, -1e6);
  EXPECT_FALSE(output.motor_saturated());
}

device_description arm_with_lag() {
  device_description device = arm();
  device.brake.coil_lag = 0.002;
  device.brake.tolerance = 0.1;
  return device;
}

// If this failed, how far the coil is behind would be wrong: fidelity reports and the make-up rest on it.
TEST(Actuator, PredictsTheCoil) {
  actuator<double> drive(arm_with_lag(), motion::rotation);
  const double reached = std::sqrt(0.004) * (1 - std::exp(-0.5));
  expect_equal(drive.drive({0.004, 0}, 0).damping_behind, 0.004 - reached * reached);
  const double fallen = reached * std::exp(-0.5);
  expect_equal(drive.drive({0, 0}, 0).damping_behind, -fallen * fallen);
  drive.reset();
  expect_equal(drive.drive({0.004, 0}, 0).damping_behind, 0.004 - reached * reached);
  drive.reset(0.004);
  EXPECT_NEAR(drive.drive({0.004, 0}, 0).damping_behind, 0, 1e-18);
}

// If this failed, the energy observer would be credited with more than the worst brake within its tolerance dissipates.
TEST(Actuator, AssuredDampingIsALowerBound) {
  const device_description device = arm_with_lag();
  actuator<double> drive(device, motion::translation);
  brake_coil<double> coil(device.brake);
  for (const double wanted : {2.0, 2.0, 0.4, 2.8, 0.0, 1.0}) {
    const actuator_output<double> output = drive.drive({wanted, 0}, 0);
    // The least dissipation ∫b v² dt for a given Δu moves with v ∝ 1/b: it is Δu²/∫dt/b.
    const int slices = 10000;
    double inverse = 0;
    for (int slice = 0; slice < slices; ++slice) {
      const double root = coil.after(std::sqrt(output.brake_damping), (slice + 0.5) * 0.001 / slices);
      inverse += 0.05 * 0.05 / (0.9 * root * root) / slices;
    }
    // The midpoint sum misses the first instant of an empty brake: a few times 1/slices.
    EXPECT_LE(output.assured_damping, 1 / inverse * (1 + 1e-3));
    coil.advance(std::sqrt(output.brake_damping), 0.001);
  }
}

// If this failed, a brake that has settled would be credited with less than it is sure to have.
TEST(Actuator, AssuredDampingOfASettledBrakeLacksTheToleranceOnly) {
  actuator<double> drive(arm_with_lag(), motion::translation);
  for (int k = 0; k < 100; ++k) drive.drive({2, 0}, 0);
  // A root, which is good to two units in the last place, its square and some products.
  EXPECT_NEAR(drive.drive({2, 0}, 0).assured_damping / (0.9 * 2), 1, 10 * 1.1e-16);
}

// If this failed, the motor would not make up for the missing damping, or would push more than the brake is sure to
// resist.
TEST(Actuator, MotorMakesUpForTheCoil) {
  const device_description device = arm_with_lag();
  actuator<double> drive(device, motion::rotation, {true, false});
  const double root = std::sqrt(0.004) * (1 - std::exp(-0.5));
  const actuator_output<double> rising = drive.drive({0.004, 0.01}, 3);
  expect_equal(rising.applied_force, 0.01 + (0.004 - root * root / 3) * 3);
  const double fallen = root * std::exp(-0.5);
  const double mean = (root * root + root * fallen + fallen * fallen) / 3;
  const actuator_output<double> falling = drive.drive({0, 0.01}, 3);
  EXPECT_LT(0.9 * fallen * fallen, mean);
  expect_equal(falling.applied_force, 0.01 - 0.9 * fallen * fallen * 3);
  actuator<double> plain(device, motion::rotation);
  EXPECT_EQ(plain.drive({0.004, 0.01}, 3).applied_force, 0.01);
}

// If this failed, a led coil would not arrive, or would be led beyond the brake's limit.
TEST(Actuator, LeadsTheCoilWithinItsLimits) {
  actuator<double> drive(arm_with_lag(), motion::rotation, {false, true});
  const actuator_output<double> reachable = drive.drive({0.0005, 0}, 0);
  EXPECT_GT(reachable.brake_damping, 0.0005);
  EXPECT_NEAR(reachable.damping_behind, 0, 1e-18);
  const actuator_output<double> unreachable = drive.drive({0.006, 0}, 0);
  expect_equal(unreachable.brake_damping, 7e-3);
  EXPECT_GT(unreachable.damping_behind, 0);
}

// If this failed, firmware in single precision would compute something else.
TEST(Actuator, WorksInFloat) {
  actuator<float> drive(arm(), motion::translation);
  const actuator_output<float> output = drive.drive({2.0f, 0.6f}, 0);
  EXPECT_FLOAT_EQ(output.motor_torque, -0.03f);
  EXPECT_FLOAT_EQ(output.brake_damping, 0.005f);
  EXPECT_FLOAT_EQ(output.coil_current, std::sqrt(0.005f / 1.75e-3f));
}

// The root of 20 squares to 4e-15 above 20: a device that takes its own limit at its word would refuse the command.
TEST(Actuator, NeverLeadsTheCoilBeyondTheBrake) {
  device_description device;
  device.brake.kind = brake_kind::eddy_current;
  device.brake.coil_lag = 0.002;
  for (double most = 1; most < 40; most += 0.37) {
    device.brake.max_damping = most;
    actuator<double> drive(device, motion::translation, {false, true});
    EXPECT_LE(drive.drive({most, 0}, 0).brake_damping, most);
  }
}

}  // namespace
}  // namespace dashpot
