#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <dashpot/servo/servo_loop.hpp>

#include "loop_fixture.hpp"

namespace dashpot::tests {
namespace {

using ServoRestart = loop_fixture;

// Broken, idle would move the motor, or model and estimator would start from somewhere else than the first sample.
TEST_F(ServoRestart, IdleSendsTheSafeCommandUntilStarted) {
  options.start_running = false;
  run(40, [](std::size_t write, servo_control& control) {
    if (write == 19) control.start();
  });
  for (std::size_t k = 0; k < 20; ++k) EXPECT_TRUE(is_safe(k)) << k;
  for (std::size_t k = 20; k < 40; ++k) EXPECT_FALSE(is_safe(k)) << k;
  EXPECT_EQ(model.resets(), 1u);
  EXPECT_EQ(model.outputs(), 20u);
  EXPECT_EQ(events(), "0.020000 s: running\n");
}

// Broken, safe would be left by itself, by a start alone, or a reset would set the motor going.
TEST_F(ServoRestart, LeavesSafeOnlyByResetAndRunsOnlyByStart) {
  make_position_nan_at(10);
  const servo_summary summary = run(60, [](std::size_t write, servo_control& control) {
    if (write == 20) control.start();
    if (write == 30) control.reset();
    if (write == 40) control.start();
  });
  for (std::size_t k = 0; k < 60; ++k) EXPECT_EQ(is_safe(k), k >= 10 && k <= 40) << k;
  EXPECT_EQ(summary.faults.of(fault::position_not_finite), 1u);
  EXPECT_EQ(model.resets(), 2u);
  EXPECT_EQ(events(),
            "0.000000 s: running\n0.010000 s: safe: position not finite: the device reads nan\n"
            "0.031000 s: idle\n0.041000 s: running\n");
}

// Broken, a reset and a start asked for together would need a third request.
TEST_F(ServoRestart, ResetAndStartTogetherRunAgainWithTheNextSample) {
  make_position_nan_at(10);
  run(30, [](std::size_t write, servo_control& control) {
    if (write == 15) control.reset(), control.start();
  });
  for (std::size_t k = 0; k < 30; ++k) EXPECT_EQ(is_safe(k), k >= 10 && k <= 15) << k;
}

// Broken, a motor of which no limit is known would be asked for an infinite torque: the force is finite, and so is what
// the motor is to make up for the coil; their sum is not.
TEST_F(ServoRestart, AFiniteForceThatOverflowsOnItsWayToTheDeviceIsAFault) {
  device_description unlimited = scripted_description();
  unlimited.motor.max_torque = 0;
  unlimited.encoder.max_speed = 0;
  unlimited.brake.coil_lag = 0.002;
  device = scripted_device(unlimited);
  options.command.actuator.make_up_with_motor = true;
  model.on_output([](std::size_t, command<double>& given) { given = {20, 1e308}; });
  estimator.on_update([](std::size_t update, double) { return update == 1 ? 1e308 : 0; });
  const servo_summary summary = run(20);
  EXPECT_EQ(summary.faults.of(fault::command_not_finite), 1u);
  for (std::size_t k = 0; k < 20; ++k) EXPECT_EQ(is_safe(k), k >= 1) << k;
}

// Broken, one number in what the device says that it applied would leave no account of the energy for the rest of the
// run, and nothing would raise the brake any more.
TEST_F(ServoRestart, AReportThatIsNotFiniteIsAFaultAndSpoilsNoAccount) {
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  options.command.energy = energy_policy::raise_brake;
  for (const actuation applied : {actuation{not_a_number, 0}, actuation{infinity, 0}, actuation{-infinity, 0},
                                  actuation{0, not_a_number}, actuation{0, infinity}, actuation{0, -infinity}}) {
    restart_parts();
    // As in ServoLoop.RaisesTheBrakeWhereItIsAskedTo.
    device.on_read([this, applied](std::size_t read, device_sample& sample) {
      sample.position = 0.01 - std::abs(static_cast<double>(read % 40) - 20.0) * 0.0005;
      if (read > 0) sample.report = {true, 0, read == 10 ? applied : device.written().back()};
      return device_status::ok;
    });
    model.on_output([](std::size_t output, command<double>& wanted) {
      wanted = {0.0, (output < 10 ? output : output + 6) % 40 < 20 ? -1.0 : 1.0};
    });
    const servo_summary summary = run(401, [](std::size_t write, servo_control& control) {
      if (write == 15) control.reset(), control.start();
    });
    EXPECT_EQ(summary.faults.total(), 1u);
    for (std::size_t k = 10; k < 16; ++k) EXPECT_TRUE(is_safe(k)) << k;
    EXPECT_TRUE(std::isfinite(summary.energy));
    EXPECT_GT(summary.lowest_energy, -5 * 0.0005);
  }
}

// Broken, a torque that is a number would spoil the account where the force that it makes at the tool is none.
TEST_F(ServoRestart, AReportedTorqueWhoseForceOverflowsIsAFault) {
  device_description arm = scripted_description();
  arm.motion = motion::rotation;
  arm.arm_radius = 0.01;
  device = scripted_device(arm);
  device.on_read([](std::size_t read, device_sample& sample) {
    if (read == 10) sample.report = {true, 0, {1e307, 11.0}};
    return device_status::ok;
  });
  EXPECT_EQ(run(20).faults.of(fault::report_not_finite), 1u);
}

// Broken, the history before a fault would leak into the run after it.
TEST_F(ServoRestart, RunAfterARestartIsThatOfAFreshModel) {
  make_position_nan_at(10);
  const servo_summary restarted = run(40, [](std::size_t write, servo_control& control) {
    if (write == 15) control.reset(), control.start();
  });
  scripted_device later;
  device_sample first, second;
  for (int read = 0; read < 16; ++read) later.read(first);
  scripted_device ahead = later;
  ahead.read(first), ahead.read(second);
  const double certain = std::abs(second.position - first.position) - 1e-5;  // known to less than one step [m]
  scripted_model fresh_model;
  scripted_estimator fresh_estimator;
  servo_options quiet;
  quiet.duration = 0.024;
  quiet.outputs.log = nullptr;
  const servo_summary fresh = servo_loop(fresh_model, later, fresh_estimator, quiet, scripted_clock{}).run();
  for (std::size_t k = 0; k < 24; ++k) {
    EXPECT_TRUE(same_bits(later.written()[k], device.written()[16 + k])) << k;
  }
  // Over the first hold the coil comes from the safe command instead of from nothing: ∫b v² dt ≥ √(b₀b₁) Δu²/Δt.
  const double credit = std::sqrt(7.5 * 11.0) * certain * certain / 0.001;
  EXPECT_NEAR(restarted.energy, fresh.energy + credit, 1e-12);
}

// Broken, a coil that went on falling in the period of a fault would be credited after it with what it had before.
TEST_F(ServoRestart, CreditsNoMoreAfterAFaultThanTheCoilHas) {
  device_description lagging = scripted_description();
  lagging.encoder.step = 0;
  lagging.brake.coil_lag = 0.002;
  lagging.brake.safe_damping = 0;
  device = scripted_device(lagging);
  device.on_read([](std::size_t read, device_sample& sample) {
    sample.position = read > 22 ? 0.001 : 0.0;
    return read == 21 ? device_status::fault : device_status::ok;
  });
  model.on_output([](std::size_t output, command<double>& wanted) { wanted = {output < 20 ? 15.0 : 0.0, 0.0}; });
  const servo_summary summary = run(24, [](std::size_t write, servo_control& control) {
    if (write == 21) control.reset(), control.start();
  });
  brake_coil<double> coil(lagging.brake);
  for (int period = 0; period < 22; ++period) coil.advance(period < 20 ? std::sqrt(15.0) : 0.0, 0.001);
  coil.advance(0, 0.001);
  EXPECT_EQ(summary.faults.total(), 1u);
  EXPECT_GE(summary.energy, 0);
  EXPECT_LE(summary.energy, coil.damping() * 0.001 * 0.001 / 0.001);
}

// Broken, a deadline missed before the start would be held against the run after it.
TEST_F(ServoRestart, DeadlinesMissedInIdleDoNotCountAgainstTheRun) {
  options.start_running = false;
  clock.oversleep(20, 9);
  const servo_summary summary = run(60, [](std::size_t write, servo_control& control) {
    if (write == 19) control.start();
  });
  EXPECT_EQ(summary.faults.total(), 0u);
  EXPECT_EQ(summary.missed_deadlines, 9u);
}

// A device with a safe state of its own, which it leaves three periods after a reset that it understands.
class stubborn_device : public scripted_device {
 public:
  explicit stubborn_device(int deaf_to = 0) : deaf_to_(deaf_to) {}

  device_status read(device_sample& sample) noexcept {
    scripted_device::read(sample);
    if (reads() == 11) safe_for_ = 1'000'000;
    return safe_for_ > 0 && safe_for_-- > 0 ? device_status::fault : device_status::ok;
  }
  device_status reset() noexcept {
    if (++resets > deaf_to_) safe_for_ = 3;
    return device_status::ok;
  }
  int resets = 0;

 private:
  int deaf_to_;
  int safe_for_ = 0;
};

struct stubborn_run {
  servo_summary summary;
  std::vector<actuation> written;
  std::string log;
  int resets;
};

stubborn_run run_stubborn(int deaf_to, std::function<void(std::size_t, servo_control&)> act) {
  stubborn_device device(deaf_to);
  scripted_model model;
  scripted_estimator estimator;
  log_text log;
  servo_options options;
  options.duration = 0.05;
  options.outputs.log = log.file();
  servo_loop loop(model, device, estimator, options, simulated_clock{});
  device.on_write([&](std::size_t write) { return act(write, loop.control()), device_status::ok; });
  const servo_summary summary = loop.run();
  return {summary, device.written(), log.text(), device.resets};
}

// Broken, a board that has gone safe by itself would stay so after the loop's reset, or trip it again before it has
// left.
TEST(ServoRestartOfADevice, WaitsForADeviceThatLeavesItsOwnSafeState) {
  const stubborn_run result = run_stubborn(0, [](std::size_t write, servo_control& control) {
    if (write == 20) control.reset(), control.start();
  });
  EXPECT_EQ(result.resets, 1);
  EXPECT_EQ(result.summary.faults.total(), 1u);
  for (std::size_t k = 0; k < 50; ++k) EXPECT_EQ(result.written[k].brake_damping == 7.5, k >= 10 && k <= 23) << k;
  EXPECT_EQ(result.log.substr(result.log.find('\n') + 1),
            "0.000000 s: running\n0.010000 s: safe: device error: the device answers 'fault'\n0.021000 s: idle\n"
            "0.021000 s: idle: cannot start: the device answers 'fault'\n0.024000 s: running\n");
}

// Broken, a reset asked for too early would reach into a run, or be kept for the fault that is yet to come.
TEST(ServoRestartOfADevice, IgnoresAResetWhileRunning) {
  const stubborn_run result = run_stubborn(0, [](std::size_t write, servo_control& control) {
    if (write == 5) control.reset();
  });
  EXPECT_EQ(result.resets, 0);
  EXPECT_STREQ(name_of(result.summary.state), "safe");
}

// Broken, a reset that was lost on its way to the board could not be repeated.
TEST(ServoRestartOfADevice, MayBeRepeatedWhileTheDeviceDoesNotHear) {
  const stubborn_run result = run_stubborn(1, [](std::size_t write, servo_control& control) {
    if (write == 20) control.reset(), control.start();
    if (write == 30) control.reset();
  });
  EXPECT_EQ(result.resets, 2);
  const std::string line = "idle: cannot start: the device answers 'fault'\n";
  const std::size_t first = result.log.find(line);
  EXPECT_NE(result.log.find(line, first + 1), std::string::npos) << result.log;
  for (std::size_t k = 0; k < 50; ++k) EXPECT_EQ(result.written[k].brake_damping == 7.5, k >= 10 && k <= 33) << k;
}

}  // namespace
}  // namespace dashpot::tests
