// What a real device changes: the reach of its brake, and an estimate of velocity that comes late.
#include <gtest/gtest.h>

#include <complex>

#include "decomposed.hpp"

namespace {

using namespace dashpot::compiler;
using dashpot::motion;

const char* const maxwell = R"({ "series": [ { "damper": 5 }, { "spring": 50 } ] })";

// Fails if the brake is asked for more than it has, or if what it lacks is not made up by the motor: |b∞ − b| is the
// gain of what the motor adds.
TEST(DeviceLimits, TheBrakeIsCapped) {
  const Device device = late_device(4);
  const Decomposed all = decomposed(kelvin_structure, {}, &device);
  EXPECT_EQ(all.result->choice().damping, 4);
  EXPECT_EQ(all.result->choice().wanted_damping, 10);
  EXPECT_EQ(all.result->choice().velocity_gain, 6);
  EXPECT_TRUE(all.reports(DiagnosticCode::damping_capped));
}

// Fails if a brake that is strong enough is reported as capped.
TEST(DeviceLimits, AStrongBrakeIsNotCapped) {
  const Device device = late_device(10);
  const Decomposed all = decomposed(kelvin_structure, {}, &device);
  EXPECT_EQ(all.result->choice().damping, 10);
  EXPECT_FALSE(all.reports(DiagnosticCode::damping_capped));
}

// Fails if a device without a brake is given damping to make.
TEST(DeviceLimits, ADeviceWithoutBrakeLeavesEverythingToTheMotor) {
  Device device = late_device(0);
  device.description.brake = {};
  const Decomposed all = decomposed(maxwell, {}, &device);
  for (const Candidate& candidate : all.result->candidates) EXPECT_EQ(candidate.damping, 0) << candidate.name;
}

// Fails if a rotary brake's reach is not brought to the tool: b = b_joint/r².
TEST(DeviceLimits, TheArmConvertsTheBrake) {
  Device device = late_device(0.007);
  device.description.motion = motion::rotation;
  device.description.arm_radius = 0.05;
  EXPECT_NEAR(decomposed(maxwell, {}, &device).result->choice().damping, 2.8, 2.8 * 0x1p-50);
}

// Fails if a translational network reaches a rotary joint without an arm between them.
TEST(DeviceLimits, MotionsThatDoNotFitAreRefused) {
  Device device = late_device(1);
  device.description.motion = motion::rotation;
  const Decomposed all = decomposed(maxwell, {}, &device);
  EXPECT_FALSE(all.result);
  EXPECT_TRUE(all.reports(DiagnosticCode::motion_mismatch));
}

// Fails if motor power put into a steady motion goes unsaid: b = 10 where the network itself damps about 0.1.
TEST(DeviceLimits, InjectedPowerIsReported) {
  const Decomposed loud = decomposed(stiff_and_soft_kelvins, choosing("largest-observer"));
  EXPECT_TRUE(loud.reports(DiagnosticCode::injects_power));
  EXPECT_FALSE(decomposed(kelvin_structure, choosing("largest-observer")).reports(DiagnosticCode::injects_power));
  EXPECT_TRUE(decomposed(maxwell, choosing(5.000001)).reports(DiagnosticCode::injects_power));
  EXPECT_FALSE(decomposed(maxwell, choosing(5.0)).reports(DiagnosticCode::injects_power));
}

// Fails if `auto` lets a late estimate drive the states where it errs most: with b = B the whole viscous part may be
// late together (the paper's (19)), with b = b∞ no estimate is needed at all.
TEST(DeviceLimits, AutoChoosesTheStateInputByItsError) {
  Device device = late_device(100);
  device.description.loop.band_high = 1;  // slow motion, as in the paper's Fig. 6
  const Decomposed all = decomposed(maxwell, {}, &device);
  EXPECT_EQ(all["paper"].state_input, StateInput::velocity);
  EXPECT_EQ(all["velocity-free"].state_input, StateInput::position);
  EXPECT_EQ(all["velocity-free"].largest_error, 0);
  const std::vector<StateInputMerit>& compared = all["paper"].state_inputs;
  ASSERT_EQ(compared.size(), 2u);
  EXPECT_EQ(compared[0].state_input, StateInput::position);
  EXPECT_GT(compared[0].largest_error, 1.5 * compared[1].largest_error);
}

// Fails if an ideal device is given anything but `position`, which cannot drift.
TEST(DeviceLimits, AnIdealDeviceIsPositionDriven) {
  EXPECT_EQ(decomposed(maxwell).result->choice().state_input, StateInput::position);
}

// Fails if `quietest-passive`, whose passivity rests on velocity driven states, is driven by anything else.
TEST(DeviceLimits, QuietestPassiveIsVelocityDriven) {
  EXPECT_EQ(decomposed(maxwell)["quietest-passive"].state_input, StateInput::velocity);
  const Device device = late_device(100);
  EXPECT_EQ(decomposed(maxwell, {}, &device)["quietest-passive"].state_input, StateInput::velocity);
}

// Fails if states are driven by velocity where b = b∞ needs no estimate.
TEST(DeviceLimits, QuietestPassiveNeedsNoEstimateAtTheFeedthrough) {
  const Decomposed all = decomposed(kelvin_structure);
  EXPECT_EQ(all["quietest-passive"].state_input, StateInput::position);
  EXPECT_EQ(all["quietest-passive"].velocity_gain, 0);
}

// Fails if slow modes are driven by estimates whose sum is not the displacement.
TEST(DeviceLimits, DriftingEstimatesNeverDriveStates) {
  const Device device = drifting_device();
  const Decomposed all = decomposed(maxwell, {}, &device);
  for (const Candidate& candidate : all.result->candidates)
    for (const StateInputMerit& merit : candidate.state_inputs)
      EXPECT_EQ(merit.state_input, StateInput::position) << candidate.name;
}

// Fails if what the motor makes is taken to come at once: of a lone spring the loop's delay and the amplifier's lag
// alone make the error, |A − 1|, largest at the end of the band.
TEST(DeviceLimits, ALateMotorErrs) {
  Device device = late_device(1);
  device.description.loop.delay_samples = 3;
  device.description.motor.amplifier_lag = 0.002;
  const double w = 2 * 3.14159265358979323846 * device.description.loop.band_high;
  const std::complex<double> late =
      std::polar(1.0, -w * 3 * device.description.loop.sample_period) / std::complex(1.0, 0.002 * w);
  const Decomposed all = decomposed(R"({ "spring": 200 })", {}, &device);
  EXPECT_NEAR(all.result->choice().largest_error / std::abs(late - 1.0), 1, 1e-9);
}

// Fails if the user can ask for that drift unwarned.
TEST(DeviceLimits, DriftingEstimatesAreRefusedWhenAskedFor) {
  const Device device = drifting_device();
  Choices choices;
  choices.state_input = StateInput::velocity;
  const Decomposed all = decomposed(maxwell, choices, &device);
  EXPECT_FALSE(all.result);
  EXPECT_TRUE(all.reports(DiagnosticCode::velocity_input_drifts));
}

// Fails if `nodal`, which exists for backward Euler, is taken with the exact scheme or is not compared without it.
TEST(DeviceLimits, NodalStatesNeedBackwardEuler) {
  Choices choices;
  choices.state_input = StateInput::nodal;
  const Decomposed refused = decomposed(maxwell, choices);
  EXPECT_FALSE(refused.result);
  EXPECT_TRUE(refused.reports(DiagnosticCode::nodal_needs_backward_euler));
  choices.scheme = Scheme::backward_euler;
  EXPECT_TRUE(decomposed(maxwell, choices).result);
  choices.state_input.reset();
  const Device device = late_device(100);
  EXPECT_EQ(decomposed(maxwell, choices, &device)["paper"].state_inputs.size(), 3u);
}

// Fails if a brake that makes thousands of times the network's force, for the motor to take off, goes unsaid.
TEST(DeviceLimits, ABrakeThatDwarfsTheNetworkIsReported) {
  const Device device = late_device(10);
  EXPECT_TRUE(decomposed(R"({ "series": [ { "damper": 10 }, { "spring": 0.01 } ] })", {}, &device)
                  .reports(DiagnosticCode::brake_dwarfs_network));
  EXPECT_FALSE(decomposed(maxwell, {}, &device).reports(DiagnosticCode::brake_dwarfs_network));
}

}  // namespace
