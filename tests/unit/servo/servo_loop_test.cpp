#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include <dashpot/servo/servo_loop.hpp>

#include "log_text.hpp"
#include "scripted_clock.hpp"
#include "scripted_device.hpp"
#include "scripted_model.hpp"

namespace dashpot::tests {
namespace {

device_sample nothing_new(device_sample sample) {
  sample.sequence = 0;
  return sample;
}

// A simulated loop on the scripted device, whose every period may be acted on between its write and the next read.
class ServoLoop : public testing::Test {
 protected:
  using loop_type = servo_loop<scripted_model, scripted_device, scripted_estimator, scripted_clock>;

  servo_summary run(std::size_t periods, std::function<void(std::size_t, servo_control&)> act = {}) {
    options.duration = 0.001 * static_cast<double>(periods);
    options.outputs.log = log.file();
    loop_type loop(model, device, estimator, options, clock);
    if (act) device.on_write([&loop, act](std::size_t write) { return act(write, loop.control()), device_status::ok; });
    return loop.run();
  }

  bool is_safe(std::size_t write) const {
    return device.written()[write].motor_torque == 0 && device.written()[write].brake_damping == 7.5;
  }

  void make_position_nan_at(std::size_t instant) {
    device.on_read([instant](std::size_t read, device_sample& sample) {
      if (read == instant) sample.position = std::nan("");
      return device_status::ok;
    });
  }

  void restart_parts() {
    device = scripted_device();
    model = scripted_model();
    estimator = scripted_estimator();
  }

  scripted_device device;
  scripted_model model;
  scripted_estimator estimator;
  scripted_clock clock;
  servo_options options;
  log_text log;
};

// Broken, a run would be a period short or long, or end with the motor on.
TEST_F(ServoLoop, RunsForItsDurationAndLeavesTheDeviceSafe) {
  const servo_summary summary = run(50);
  EXPECT_EQ(summary.periods, 50u);
  EXPECT_EQ(device.reads(), 50u);
  ASSERT_EQ(device.written().size(), 51u);
  EXPECT_FALSE(is_safe(49));
  EXPECT_TRUE(is_safe(50));
  EXPECT_TRUE(summary.left_safe);
  EXPECT_STREQ(name_of(summary.state), "running");
  EXPECT_EQ(summary.lateness.count(), 50u);
  EXPECT_EQ(summary.response.count(), 50u);
  EXPECT_EQ(summary.busy.count(), 50u);
}

// Broken, the command would not be the model's, in the device's coordinate and sign, for this very sample.
TEST_F(ServoLoop, SendsTheModelsCommandForTheSampleJustRead) {
  run(50);
  scripted_device same_motion;
  generated::second_order_maxwell law;
  backward_difference<double> difference(10, 0.001);
  for (std::size_t k = 0; k < 50; ++k) {
    device_sample sample;
    same_motion.read(sample);
    if (k == 0) law.reset(sample.position), difference.reset(sample.position);
    const command<double> wanted = law.step(sample.position, difference.update(sample.position));
    EXPECT_EQ(device.written()[k].motor_torque, -wanted.force) << k;
    EXPECT_DOUBLE_EQ(device.written()[k].brake_damping, wanted.damping) << k;
  }
}

// Broken, the model would be updated without its output, or before the command has left.
TEST_F(ServoLoop, UpdatesTheModelOnceAfterEachCommand) {
  std::vector<std::size_t> updates_at_write;
  run(20, [&](std::size_t, servo_control&) { updates_at_write.push_back(model.updates()); });
  for (std::size_t k = 0; k < 20; ++k) EXPECT_EQ(updates_at_write[k], k);
  EXPECT_EQ(model.updates(), 20u);
  EXPECT_EQ(model.outputs(), 20u);
}

// Broken, Ctrl-C would be obeyed late, or leave the device as it was.
TEST_F(ServoLoop, StopEndsTheLoopBeforeTheNextReadAndLeavesTheDeviceSafe) {
  const servo_summary summary = run(1000, [](std::size_t write, servo_control& control) {
    if (write == 123) control.stop();
  });
  EXPECT_EQ(device.reads(), 124u);
  EXPECT_TRUE(is_safe(124));
  EXPECT_TRUE(summary.left_safe);
}

// Broken, a device that misses the last command would be left with the motor on and the run be called safe.
TEST_F(ServoLoop, RepeatsTheLastSafeCommandWhileTheDeviceRefusesIt) {
  device.on_write([](std::size_t write) { return write >= 10 && write < 13 ? device_status::no_data : device_status::ok; });
  EXPECT_TRUE(run(10).left_safe);
  EXPECT_EQ(device.written().size(), 14u);
}

// Broken, a device that takes no command any more would hold up the end of the program, or be called safe.
TEST_F(ServoLoop, GivesUpOnADeviceThatTakesNoCommand) {
  device.on_write([](std::size_t write) { return write >= 10 ? device_status::disconnected : device_status::ok; });
  EXPECT_FALSE(run(10).left_safe);
  EXPECT_EQ(device.written().size(), 14u);
}

// Broken, idle would move the motor, or model and estimator would start from somewhere else than the first sample.
TEST_F(ServoLoop, IdleSendsTheSafeCommandUntilStarted) {
  options.start_running = false;
  run(40, [](std::size_t write, servo_control& control) {
    if (write == 19) control.start();
  });
  for (std::size_t k = 0; k < 20; ++k) EXPECT_TRUE(is_safe(k)) << k;
  for (std::size_t k = 20; k < 40; ++k) EXPECT_FALSE(is_safe(k)) << k;
  EXPECT_EQ(model.resets(), 1u);
  EXPECT_EQ(model.outputs(), 20u);
  EXPECT_EQ(log.text().substr(log.text().find('\n') + 1), "0.020000 s: running\n");
}

// Broken, safe would be left by itself, by a start alone, or a reset would set the motor going.
TEST_F(ServoLoop, LeavesSafeOnlyByResetAndRunsOnlyByStart) {
  make_position_nan_at(10);
  const servo_summary summary = run(60, [](std::size_t write, servo_control& control) {
    if (write == 20) control.start();
    if (write == 30) control.reset();
    if (write == 40) control.start();
  });
  for (std::size_t k = 0; k < 60; ++k) EXPECT_EQ(is_safe(k), k >= 10 && k <= 40) << k;
  EXPECT_EQ(summary.faults.of(fault::position_not_finite), 1u);
  EXPECT_EQ(model.resets(), 2u);
  EXPECT_EQ(log.text().substr(log.text().find('\n') + 1),
            "0.000000 s: running\n0.010000 s: safe: position not finite: the device reads nan\n"
            "0.031000 s: idle\n0.041000 s: running\n");
}

// Broken, a reset and a start asked for together would need a third request.
TEST_F(ServoLoop, ResetAndStartTogetherRunAgainWithTheNextSample) {
  make_position_nan_at(10);
  run(30, [](std::size_t write, servo_control& control) {
    if (write == 15) control.reset(), control.start();
  });
  for (std::size_t k = 0; k < 30; ++k) EXPECT_EQ(is_safe(k), k >= 10 && k <= 15) << k;
}

// Broken, the history before a fault would leak into the run after it.
TEST_F(ServoLoop, RunAfterARestartIsThatOfAFreshModel) {
  make_position_nan_at(10);
  run(40, [](std::size_t write, servo_control& control) {
    if (write == 15) control.reset(), control.start();
  });
  scripted_device later;
  device_sample sample;
  for (int read = 0; read < 16; ++read) later.read(sample);
  scripted_model fresh_model;
  scripted_estimator fresh_estimator;
  servo_options quiet;
  quiet.duration = 0.024;
  quiet.outputs.log = nullptr;
  servo_loop(fresh_model, later, fresh_estimator, quiet, scripted_clock{}).run();
  for (std::size_t k = 0; k < 24; ++k) {
    EXPECT_EQ(std::memcmp(&later.written()[k], &device.written()[16 + k], sizeof(actuation)), 0) << k;
  }
}

// Broken, a lost sample would stop the loop, step the model twice, or command something new without knowing anything new.
TEST_F(ServoLoop, HoldsTheLastCommandWithoutAFreshSample) {
  device.on_read([](std::size_t read, device_sample& sample) {
    if (read == 20) return device_status::corrupted;
    if (read == 21) sample = nothing_new(sample);
    return device_status::ok;
  });
  const servo_summary summary = run(40);
  EXPECT_EQ(summary.held, 2u);
  EXPECT_EQ(summary.faults.total(), 0u);
  EXPECT_EQ(model.outputs(), 38u);
  EXPECT_EQ(model.updates(), 38u);
  for (std::size_t k : {20u, 21u}) {
    EXPECT_EQ(std::memcmp(&device.written()[k], &device.written()[19], sizeof(actuation)), 0) << k;
  }
  EXPECT_NE(device.written()[22].motor_torque, device.written()[19].motor_torque);
}

// Broken, missed deadlines that the device allows would end the run, or go uncounted.
TEST_F(ServoLoop, SurvivesAndCountsAllowedMissedDeadlines) {
  clock.oversleep(20, 3);
  const servo_summary summary = run(40);
  EXPECT_EQ(summary.missed_deadlines, 3u);
  EXPECT_EQ(summary.periods, 37u);
  EXPECT_EQ(summary.beyond_jitter, 1u);
  EXPECT_EQ(summary.faults.total(), 0u);
  EXPECT_EQ(summary.lateness.max(), 3'000'000u);
}

// Broken, the energy of the summary would not be the sum over holds of force times displacement plus what the brake took.
TEST_F(ServoLoop, CountsTheEnergyOfEveryHold) {
  device_description ideal = scripted_description();
  ideal.encoder.step = 0;
  device = scripted_device(ideal);
  EXPECT_EQ(ideal.brake.coil_lag, 0);
  std::vector<double> positions;
  device.on_read([&](std::size_t read, device_sample& sample) {
    sample.position = 0.02 * std::sin(0.01 * static_cast<double>(read));
    positions.push_back(sample.position);
    return device_status::ok;
  });
  const servo_summary summary = run(400);
  double energy = 0;
  for (std::size_t k = 0; k + 1 < 400; ++k) {
    const double moved = positions[k + 1] - positions[k];
    // Over the first hold the coil rises from nothing, of which nothing is certain.
    const double damping = k == 0 ? 0 : device.written()[k].brake_damping;
    energy += -device.written()[k].motor_torque * moved + damping * moved * moved / 0.001;
  }
  EXPECT_NEAR(summary.energy, energy, 1e-12 * std::abs(energy));
}

// Broken, what the motor creates would be counted and not paid for where the brake is asked to.
TEST_F(ServoLoop, RaisesTheBrakeWhereItIsAskedTo) {
  // 0.5 mm to and fro, and a force of 1 N that always pushes along: 0.5 mJ a hold comes out.
  const auto triangle = [](std::size_t read, device_sample& sample) {
    sample.position = 0.01 - std::abs(static_cast<double>(read % 40) - 20.0) * 0.0005;
    return device_status::ok;
  };
  const auto push = [](std::size_t output, command<double>& wanted) { wanted = {0.0, output % 40 < 20 ? -1.0 : 1.0}; };
  device.on_read(triangle);
  model.on_output(push);
  EXPECT_NEAR(run(401).lowest_energy, -400 * 0.0005, 1e-12);
  restart_parts();
  device.on_read(triangle);
  model.on_output(push);
  options.command.energy = energy_policy::raise_brake;
  // The estimate that predicts the next hold is 5 ms late, so for 5 holds after a reversal a debt may grow.
  EXPECT_GT(run(401).lowest_energy, -5 * 0.0005);
}

// Broken, a simulated run would lose records when it is faster than its writer, or differ from run to run.
TEST_F(ServoLoop, SimulatedRunLogsEveryPeriodAlike) {
  options.telemetry_capacity = 16;
  log_text first, second;
  options.outputs.csv = first.file();
  EXPECT_EQ(run(1000).telemetry_dropped, 0u);
  restart_parts();
  options.outputs.csv = second.file();
  run(1000);
  const std::string table = first.text();
  EXPECT_EQ(table, second.text());
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1001);
}

struct resettable_device : scripted_device {
  device_status reset() noexcept { return ++resets, device_status::ok; }
  int resets = 0;
};

// Broken, a board that has gone safe by itself would stay so after the loop's reset.
TEST(ServoLoopReset, ReachesADeviceThatHasAResetOfItsOwn) {
  resettable_device device;
  scripted_model model;
  scripted_estimator estimator;
  servo_options options;
  options.duration = 0.05;
  options.outputs.log = nullptr;
  servo_loop loop(model, device, estimator, options, simulated_clock{});
  device.on_read([](std::size_t read, device_sample&) { return read == 10 ? device_status::fault : device_status::ok; });
  device.on_write([&loop](std::size_t write) {
    if (write == 20) loop.control().reset();
    return device_status::ok;
  });
  loop.run();
  EXPECT_EQ(device.resets, 1);
}

// Broken, a model whose facts are known only when it is loaded could not be refused.
TEST(ServoLoopFacts, ModelMayStateItsFactsAtRunTime) {
  struct loaded_model : scripted_model {
    model_facts facts() const noexcept { return {0.002, dashpot::motion::translation, true, "", "", "", 0}; }
  } model;
  scripted_device device;
  scripted_estimator estimator;
  servo_options options;
  options.outputs.log = nullptr;
  EXPECT_EQ(servo_loop(model, device, estimator, options, simulated_clock{}).run().verdict, admission::other_rate);
}

// Broken, Ctrl-C would kill the process with the motor on, or go on asking a loop that is gone.
TEST(StopOnSignals, AsksTheLoopToStopAndGivesTheHandlersBack) {
  struct sigaction before {};
  sigaction(SIGINT, nullptr, &before);
  for (const int signal : {SIGINT, SIGTERM}) {
    servo_control control;
    const stop_on_signals guard(control);
    EXPECT_FALSE(control.stop_requested());
    std::raise(signal);
    EXPECT_TRUE(control.stop_requested());
  }
  struct sigaction after {};
  sigaction(SIGINT, nullptr, &after);
  EXPECT_EQ(after.sa_handler, before.sa_handler);
}

}  // namespace
}  // namespace dashpot::tests
