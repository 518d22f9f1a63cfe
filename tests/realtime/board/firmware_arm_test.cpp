// The firmware of two axes, with a law of two axes on board, under QEMU.
#include <iostream>

#include <kelvin_field.hpp>

#include <gtest/gtest.h>

#include <dashpot/board/board_device.hpp>

#include "firmware_twin.hpp"
#include "in_process_board.hpp"
#include "qemu_board.hpp"

namespace dashpot::board {
namespace {

using law = generated::kelvin_field;

constexpr arm_configure_message own_model = {model_runner<law>::period, {0.004F, 0.005F},     {10, 10}, 0,
                                             sampling::free_running,    controller::own_model};

model_runner<law> runner_of_arm() {
  velocity_description window;  // as the firmware is built with
  window.window = ARM_VELOCITY_WINDOW;
  return {{test_arm::encoder_step, test_arm::encoder_step}, {window, window}, 1};
}

// Two encoders, estimators and motors, the kinematics and both brakes, in single precision: one bit of difference
// anywhere, in any step of a closed loop, would show.
TEST(ArmFirmware, RunsALawOfTwoAxesBitForBitLikeTheHost) {
  DASHPOT_SKIP_WITHOUT_QEMU();
  qemu_board board({}, ARM_BOARD_FIRMWARE);
  expect_the_same_bits<law, test_arm>(board.connect(), own_model, runner_of_arm(), 1000);
}

// What the firmware's README says that it costs, and a sixth more.
TEST(ArmFirmware, OneStepStaysWithinItsBudgetOfInstructions) {
  DASHPOT_SKIP_WITHOUT_QEMU();
  qemu_board board({"-icount", "shift=0"}, ARM_BOARD_FIRMWARE);
  conversation talk(board.connect());
  talk.say(ask_statistics_message());
  const auto counts = talk.answer<statistics_message>();
  ASSERT_EQ(counts.model_calls, 10'000U);
  constexpr double instructions_per_tick = 40;  // 25 MHz, one instruction a nanosecond
  const double instructions = instructions_per_tick * counts.model_ticks / counts.model_calls;
  std::cout << "instructions per step on a Cortex-M4F: " << instructions << '\n';
  EXPECT_LE(instructions, 400);
  EXPECT_GT(instructions, 200) << "less than the arithmetic alone";
}

// The host computes: what it sends to each motor and brake is in force on the board, and each joint's counts come back.
TEST(ArmFirmware, ObeysAHostJointByJoint) {
  DASHPOT_SKIP_WITHOUT_QEMU();
  qemu_board emulated({}, ARM_BOARD_FIRMWARE);
  board_options patient;
  patient.watchdog_periods = 5000;
  patient.late_limit = 1e3;
  patient.start_time = 30'000;
  arm_board_device device(emulated.connect(), described_arm_board(), patient);
  std::string error;
  ASSERT_TRUE(device.start(error)) << error;
  EXPECT_STREQ(device.description_of_board().name, "dashpot mps2");
  arm_sample sample;
  for (unsigned i = 1; i <= 100; ++i) {
    const double part = i / 8192.0;  // exact in single precision
    const arm_actuation sent = {{part, -part / 2}, {part / 4, part / 8}};
    ASSERT_EQ(device.write(sent), device_status::ok);
    do device.wait_for_sample(1000);
    while (device.read(sample) != device_status::ok);
    ASSERT_EQ(sample.report.applied.motor_torque[0], sent.motor_torque[0]);
    ASSERT_EQ(sample.report.applied.motor_torque[1], sent.motor_torque[1]);
    ASSERT_EQ(sample.report.applied.brake_damping[0], sent.brake_damping[0]);
    ASSERT_EQ(sample.report.applied.brake_damping[1], sent.brake_damping[1]);
  }
  // The hand swings by 0.05 rad, and yields by 0.012 N m ÷ 0.6 N m/rad at most; the joints are 1.5 rad apart.
  EXPECT_NEAR(sample.position[0], static_cast<double>(test_arm::middle[0]), 0.1);
  EXPECT_NEAR(sample.position[1], static_cast<double>(test_arm::middle[1]), 0.1);
  EXPECT_EQ(device.statistics().frames.discarded_bytes, 0U);
}

}  // namespace
}  // namespace dashpot::board
