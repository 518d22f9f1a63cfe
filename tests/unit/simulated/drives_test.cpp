// The simulated motor and brake against their closed forms.
#include <cmath>

#include <gtest/gtest.h>

#include "plain_device.hpp"

namespace dashpot::simulated {
namespace {

// A few roundings of sums and products of this size.
constexpr double rounding = 1e-14;

// If this failed, the amplifier would have a wrong time constant, or act in steps of the sampling.
TEST(Drives, AmplifierLagIsFirstOrder) {
  device_description description = plain_device();
  description.motor.amplifier_lag = 0.0007;
  simulated_device device(description);
  run(device, 4, {0.3, 0});
  EXPECT_NEAR(device.truth().motor_torque, 0.3 * (1 - std::exp(-0.003 / 0.0007)), rounding);
  run(device, 2, {-0.1, 0});
  const double turned = 0.3 * (1 - std::exp(-0.003 / 0.0007));
  EXPECT_NEAR(device.truth().motor_torque, -0.1 + (turned + 0.1) * std::exp(-0.002 / 0.0007), rounding);
}

// If this failed, the motor's force would jump where the amplifier can only slew, or the lag would not take over near
// the end.
TEST(Drives, TheMotorSlewsStraightAndThenSettles) {
  device_description description = plain_device();
  description.motor.slew = 50;
  simulated_device straight(description);
  run(straight, 4, {0.3, 0});
  EXPECT_NEAR(straight.truth().motor_torque, 50 * 0.003, rounding);
  run(straight, 2, {-0.1, 0});
  EXPECT_NEAR(straight.truth().motor_torque, 50 * 0.003 - 50 * 0.002, rounding);
  description.motor.amplifier_lag = 0.002;
  simulated_device lagging(description);
  run(lagging, 7, {0.3, 0});
  // Straight until the lag alone is slower, which is 0.1 before the end.
  EXPECT_NEAR(lagging.truth().motor_torque, 0.3 - 0.1 * std::exp(-(0.006 - 0.2 / 50) / 0.002), 10 * rounding);
}

// If this failed, the lag would act on the damping instead of on the current, whose square it is.
TEST(Drives, CoilLagActsOnTheCurrent) {
  device_description description = plain_device();
  description.brake.coil_lag = 0.002;
  simulated_device device(description);
  run(device, 4, {0, 9});
  const double current = 3 * (1 - std::exp(-0.003 / 0.002));
  EXPECT_NEAR(device.truth().brake_damping, current * current, 10 * rounding);
  run(device, 2, {0, 0});
  const double left = current * std::exp(-0.002 / 0.002);
  EXPECT_NEAR(device.truth().brake_damping, left * left, 10 * rounding);
}

// If this failed, the rail voltage would not limit the current's slope, or the lag would not take over where the slope
// is less.
TEST(Drives, CoilSlewsStraightAndThenSettles) {
  device_description description = plain_device();
  description.brake.coil_lag = 0.001;
  description.brake.damping_per_current_squared = 4;
  description.brake.slew = 250;
  simulated_device device(description);
  run(device, 3, {0, 16});
  // i from 0 to √(16/4) A: straight at 250 A/s until the lag alone is slower, which is 0.25 A before the end.
  EXPECT_NEAR(device.truth().brake_damping, 4 * 0.5 * 0.5, 10 * rounding);
  run(device, 7, {0, 16});
  const double straight = (2 - 0.25) / 250;
  const double current = 2 - 0.25 * std::exp(-(0.009 - straight) / 0.001);
  EXPECT_NEAR(device.truth().brake_damping, 4 * current * current, 10 * rounding);
}

// If this failed, the brake would not fade with speed, or it would fade at a speed other than the stated one.
TEST(Drives, BrakeFadesAtSpeed) {
  device_description description = plain_device();
  description.brake.critical_speed = 2;
  scenario scene;
  scene.initial_velocity = 4;
  simulated_device device(description, scene);
  run(device, 2, {0, 10});
  const double speed = device.truth().velocity;
  EXPECT_NEAR(device.truth().brake_damping, 10 / (1 + speed * speed / 4), 10 * rounding);
  // m v̇ = −b v/(1 + (v/v_c)²) has ln v + v²/(2 v_c²) fall at the rate b/m.
  const double fall = std::log(4) + 16.0 / 8 - std::log(speed) - speed * speed / 8;
  // Two steps of 0.5 ms with b h/m = 0.025: below 1e-9 by the order 4.
  EXPECT_NEAR(fall, 10 / 0.2 * 0.001, 1e-9);
}

// If this failed, what is left without current would be missing, or would be scaled like the rest.
TEST(Drives, ResidualDampingComesOnTop) {
  device_description description = plain_device();
  description.brake.residual_damping = 0.25;
  description.brake.tolerance = 0.1;
  scenario scene;
  scene.gain = brake_gain::lowest;
  simulated_device device(description, scene);
  run(device, 2);
  EXPECT_EQ(device.truth().brake_damping, 0.25);
  run(device, 2, {0, 8});
  EXPECT_NEAR(device.truth().brake_damping, 0.9 * 8 + 0.25, 10 * rounding);
  scene.gain = brake_gain::highest;
  simulated_device strong(description, scene);
  run(strong, 2, {0, 8});
  EXPECT_NEAR(strong.truth().brake_damping, 1.1 * 8 + 0.25, 10 * rounding);
}

// If this failed, a drawn brake would leave its tolerance, or every seed would draw the same.
TEST(Drives, DrawnGainLiesWithinTheTolerance) {
  device_description description = plain_device();
  description.brake.tolerance = 0.05;
  double least = 2, most = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    scenario scene;
    scene.gain = brake_gain::drawn;
    scene.seed = seed;
    simulated_device device(description, scene);
    run(device, 2, {0, 1});
    least = std::min(least, device.truth().brake_damping);
    most = std::max(most, device.truth().brake_damping);
  }
  EXPECT_GE(least, 0.95);
  EXPECT_LE(most, 1.05);
  // 200 uniform draws all miss one end's tenth of the interval once in 10⁹ sets of seeds.
  EXPECT_LT(least, 0.96);
  EXPECT_GT(most, 1.04);
}

// If this failed, demands beyond what motor and brake can do would be obeyed.
TEST(Drives, DemandsAreCutToTheLimits) {
  device_description description = plain_device();
  description.motor.max_torque = 0.5;
  description.brake.max_damping = 3;
  simulated_device device(description);
  run(device, 2, {-2, 7});
  EXPECT_EQ(device.truth().motor_torque, -0.5);
  EXPECT_NEAR(device.truth().brake_damping, 3, rounding);
  run(device, 2, {2, -7});
  EXPECT_EQ(device.truth().motor_torque, 0.5);
  EXPECT_EQ(device.truth().brake_damping, 0);
  description.brake.kind = brake_kind::none;
  simulated_device brakeless(description);
  run(brakeless, 2, {0, 1});
  EXPECT_EQ(brakeless.truth().brake_damping, 0);
}

}  // namespace
}  // namespace dashpot::simulated
