#include "network/device.hpp"

#include <gtest/gtest.h>

#include <dashpot/estimators/estimator_names.hpp>

#include "front_end_run.hpp"

namespace dashpot::compiler {
namespace {

std::string device_with(const std::string& keys) {
  return R"({"dashpot_device": 1, "name": "arm", "loop": {"rate": "1 kHz"}, )" + keys + "}";
}

// If this fails, a number in a device file reaches the certificate in another unit, or under another name.
TEST(Device, IsReadIntoSi) {
  const DeviceRun run(R"json({
    "dashpot_device": 1, "name": "rig", "source": "made up", "motion": "rotation", "arm_radius": "50 mm",
    "loop": { "rate": "10 kHz", "jitter": "50 us", "delay_samples": 1, "band": ["0.2 Hz", "40 Hz"],
              "reference_frequency": "2 Hz", "missed_deadlines_allowed": 5 },
    "encoder": { "counts_per_turn": 65536, "quantiser": "round", "range": ["-0.8 rad", "0.7 rad"],
                 "max_speed": "30 rad/s" },
    "velocity": { "estimator": "butterworth", "order": 4, "cutoff": "120 Hz" },
    "motor": { "torque_constant": "43 mN m/A", "max_torque": "0.1 N m", "amplifier_lag": "0.2 ms", "slew": "30 mN m/ms",
               "saturation_allowed": "0.2 s", "noise": "0.5 mN m" },
    "brake": { "kind": "eddy_current", "max_damping": "7 mN m s/rad",
               "damping_per_current_squared": "6 mN m s/(rad A^2)", "residual_damping": "0.1 mN m s/rad",
               "tolerance": "5 %", "coil_lag": "1 ms", "slew": "2 A/ms", "critical_speed": "400 rad/s",
               "safe_damping": "3 mN m s/rad" },
    "mechanics": { "inertia": "0.3 g m^2", "damping": "20 uN m s/rad", "coulomb_friction": "1 mN m",
      "mode": { "comment": "of the arm", "frequency": "0.4 kHz", "damping_ratio": "2 %", "mass": "20 mg m^2" },
      "backlash": "1 mrad" },
    "assumed": ["brake.coil_lag", "arm_radius", "mechanics.mode.mass"] })json");
  ASSERT_TRUE(run.device) << run.said();
  const device_description& d = run.device->description;
  EXPECT_EQ(run.device->name, "rig");
  EXPECT_EQ(run.device->source, "made up");
  EXPECT_EQ(run.device->assumed, (std::vector<std::string>{"brake.coil_lag", "arm_radius", "mechanics.mode.mass"}));
  EXPECT_EQ(run.device->digest.size(), 64u);
  EXPECT_EQ(d.motion, motion::rotation);
  EXPECT_EQ(d.arm_radius, 0.05);
  EXPECT_EQ(d.loop.sample_period, 0.0001);
  EXPECT_EQ(d.loop.jitter, 0.00005);
  EXPECT_EQ(d.loop.delay_samples, 1u);
  EXPECT_EQ(d.loop.band_low, 0.2);
  EXPECT_EQ(d.loop.band_high, 40);
  EXPECT_EQ(d.loop.reference_frequency, 2);
  EXPECT_EQ(d.loop.missed_deadlines_allowed, 5u);
  EXPECT_EQ(d.encoder.step, 9.587379924285257e-05);  // 2π/65536
  EXPECT_EQ(d.encoder.rounding, quantiser::round);
  EXPECT_EQ(d.encoder.range_low, -0.8);
  EXPECT_EQ(d.encoder.range_high, 0.7);
  EXPECT_EQ(d.encoder.max_speed, 30);
  EXPECT_EQ(d.velocity.estimator, estimator_kind::butterworth);
  EXPECT_EQ(d.velocity.order, 4u);
  EXPECT_EQ(d.velocity.cutoff, 120);
  EXPECT_EQ(d.motor.torque_constant, 0.043);
  EXPECT_EQ(d.motor.max_torque, 0.1);
  EXPECT_DOUBLE_EQ(d.motor.slew, 30);
  EXPECT_EQ(d.motor.amplifier_lag, 0.0002);
  EXPECT_EQ(d.motor.saturation_allowed, 0.2);
  EXPECT_EQ(d.motor.noise, 0.0005);
  EXPECT_EQ(d.brake.kind, brake_kind::eddy_current);
  EXPECT_EQ(d.brake.max_damping, 0.007);
  EXPECT_EQ(d.brake.damping_per_current_squared, 0.006);
  EXPECT_EQ(d.brake.residual_damping, 0.0001);
  EXPECT_EQ(d.brake.tolerance, 0.05);
  EXPECT_EQ(d.brake.coil_lag, 0.001);
  EXPECT_EQ(d.brake.slew, 2000);
  EXPECT_EQ(d.brake.critical_speed, 400);
  EXPECT_EQ(d.brake.safe_damping, 0.003);
  EXPECT_EQ(d.mechanics.inertia, 0.0003);
  EXPECT_EQ(d.mechanics.damping, 0.00002);
  EXPECT_EQ(d.mechanics.coulomb_friction, 0.001);
  EXPECT_EQ(d.mechanics.mode.frequency, 400);
  EXPECT_EQ(d.mechanics.mode.damping_ratio, 0.02);
  EXPECT_EQ(d.mechanics.mode.mass, 2e-5);
  EXPECT_EQ(d.mechanics.backlash, 0.001);
}

// If this fails, what a file does not say is no longer ideal.
TEST(Device, IsIdealWhereTheFileIsSilent) {
  const DeviceRun run(R"({"dashpot_device": 1, "name": "arm", "loop": {"rate": 2000}})");
  ASSERT_TRUE(run.device) << run.said();
  const device_description& d = run.device->description;
  EXPECT_EQ(d.motion, motion::translation);
  EXPECT_EQ(d.loop.sample_period, 0.0005);
  EXPECT_EQ(d.loop.delay_samples, 0u);
  EXPECT_EQ(d.encoder.step, 0);
  EXPECT_EQ(d.brake.kind, brake_kind::none);
  EXPECT_EQ(d.motor.max_torque, 0);
  EXPECT_EQ(d.mechanics.inertia, 0);
  EXPECT_EQ(d.motor.noise, 0);
  EXPECT_EQ(d.mechanics.mode.frequency, 0);
  EXPECT_EQ(d.mechanics.backlash, 0);
}

// If this fails, a device that translates is measured in radians.
TEST(Device, OfTranslationTakesMetresAndNewtons) {
  const DeviceRun run(device_with(R"("encoder": {"resolution": "30 um", "range": ["0 mm", "100 mm"]},
      "motor": {"torque_constant": "2 N/A"}, "brake": {"kind": "shorted_motor", "max_damping": "2.8 N s/m"},
      "mechanics": {"inertia": "200 g"})"));
  ASSERT_TRUE(run.device) << run.said();
  const device_description& d = run.device->description;
  EXPECT_EQ(d.encoder.step, 0.00003);
  EXPECT_EQ(d.encoder.range_high, 0.1);
  EXPECT_EQ(d.motor.torque_constant, 2);
  EXPECT_EQ(d.brake.kind, brake_kind::shorted_motor);
  EXPECT_EQ(d.mechanics.inertia, 0.2);
}

struct EstimatorExample {
  std::string keys;
  estimator_kind kind;
};

// If this fails, one of the estimators cannot be chosen in a device file.
TEST(Device, MayUseEveryEstimator) {
  const EstimatorExample examples[] = {
      {R"("estimator": "backward_difference", "window": 15)", estimator_kind::backward_difference},
      {R"("estimator": "least_squares", "window": 15)", estimator_kind::least_squares},
      {R"("estimator": "butterworth", "order": 2, "cutoff": "50 Hz")", estimator_kind::butterworth},
      {R"("estimator": "inverse_time")", estimator_kind::inverse_time},
      {R"("estimator": "foaw", "window": 20, "fit": "best")", estimator_kind::foaw},
      {R"("estimator": "kalman", "acceleration": "5 m/s^2")", estimator_kind::kalman},
      {R"("estimator": "super_twisting", "acceleration": "5 m/s^2")", estimator_kind::super_twisting},
      {R"("estimator": "tracking_differentiator", "acceleration": "5 m/s^2", "filter_factor": 3)",
       estimator_kind::tracking_differentiator},
      {R"("estimator": "sensor", "noise": "1 mm/s", "bandwidth": "200 Hz")", estimator_kind::sensor},
      {R"("estimator": "interval_difference")", estimator_kind::interval_difference}};
  ASSERT_EQ(std::size(examples), std::size(all_estimators));
  for (const EstimatorExample& example : examples) {
    const DeviceRun run(device_with(R"("encoder": {"resolution": "30 um"}, "velocity": {)" + example.keys + "}"));
    ASSERT_TRUE(run.device) << run.said();
    EXPECT_EQ(run.device->description.velocity.estimator, example.kind);
  }
}

// If this fails, settings of an estimator are read and dropped.
TEST(Device, PassesTheSettingsOfItsEstimatorOn) {
  const DeviceRun foaw(device_with(
      R"("encoder": {"resolution": 1e-5}, "velocity": {"estimator": "foaw", "window": 20, "fit": "best"})"));
  const DeviceRun sensor(
      device_with(R"("velocity": {"estimator": "sensor", "noise": "1 mm/s", "bandwidth": "200 Hz"})"));
  const DeviceRun tracker(device_with(
      R"("velocity": {"estimator": "tracking_differentiator", "acceleration": "5 m/s^2", "filter_factor": 3})"));
  ASSERT_TRUE(foaw.device && sensor.device && tracker.device);
  EXPECT_EQ(foaw.device->description.velocity.window, 20u);
  EXPECT_TRUE(foaw.device->description.velocity.best_fit);
  EXPECT_EQ(sensor.device->description.velocity.noise, 0.001);
  EXPECT_EQ(sensor.device->description.velocity.bandwidth, 200);
  EXPECT_EQ(tracker.device->description.velocity.acceleration, 5);
  EXPECT_EQ(tracker.device->description.velocity.filter_factor, 3);
}

}  // namespace
}  // namespace dashpot::compiler
