#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>

#include "loop_fixture.hpp"

namespace dashpot::tests {
namespace {

using ServoLoop = loop_fixture;

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

// Broken, a translational network on a rotating arm would be rendered r or r² times too strong.
TEST_F(ServoLoop, CarriesTranslationToARotaryJoint) {
  device_description arm = scripted_description();
  arm.motion = motion::rotation;
  arm.arm_radius = 0.25;
  device = scripted_device(arm);
  run(50);
  scripted_device same_motion;
  generated::second_order_maxwell law;
  backward_difference<double> difference(10, 0.001);
  for (std::size_t k = 0; k < 50; ++k) {
    device_sample sample;
    same_motion.read(sample);
    if (k == 0) law.reset(0.25 * sample.position), difference.reset(sample.position);
    const command<double> wanted = law.step(0.25 * sample.position, 0.25 * difference.update(sample.position));
    EXPECT_DOUBLE_EQ(device.written()[k].motor_torque, -0.25 * wanted.force) << k;
    EXPECT_DOUBLE_EQ(device.written()[k].brake_damping, 0.0625 * wanted.damping) << k;
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
  device.on_write(
      [](std::size_t write) { return write >= 10 && write < 13 ? device_status::no_data : device_status::ok; });
  std::uint64_t waits = 0;
  clock.count_waits_in(waits);
  EXPECT_TRUE(run(10).left_safe);
  EXPECT_EQ(device.written().size(), 14u);
  EXPECT_EQ(waits, 14u);  // ten periods, the end of the last, and one between two attempts
}

// Broken, a device that takes no command any more would hold up the end of the program, or be called safe.
TEST_F(ServoLoop, GivesUpOnADeviceThatTakesNoCommand) {
  device.on_write([](std::size_t write) { return write >= 10 ? device_status::disconnected : device_status::ok; });
  EXPECT_FALSE(run(10).left_safe);
  EXPECT_EQ(device.written().size(), 14u);
}

// Broken, a lost sample would stop the loop, step the model twice, or command something new without knowing anything
// new.
TEST_F(ServoLoop, HoldsTheLastCommandWithoutAFreshSample) {
  device.on_read([](std::size_t read, device_sample& sample) {
    if (read == 20) return device_status::corrupted;
    if (read == 21) sample.sequence = 0;
    return device_status::ok;
  });
  const servo_summary summary = run(40);
  EXPECT_EQ(summary.held, 2u);
  EXPECT_EQ(summary.faults.total(), 0u);
  EXPECT_EQ(model.outputs(), 38u);
  EXPECT_EQ(model.updates(), 38u);
  for (std::size_t k : {20u, 21u}) {
    EXPECT_TRUE(same_bits(device.written()[k], device.written()[19])) << k;
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

// Broken, a device that states no jitter would have every wake-up counted as too late.
TEST_F(ServoLoop, CountsNoLatenessAgainstAJitterThatIsNotStated) {
  device_description silent = scripted_description();
  silent.loop.jitter = 0;
  device = scripted_device(silent);
  clock.oversleep(20, 1);
  EXPECT_EQ(run(40).beyond_jitter, 0u);
}

// Broken, nobody would know that motor or brake gave less than the model asked for.
TEST_F(ServoLoop, CountsClippedCommands) {
  model.on_output([](std::size_t output, command<double>& wanted) {
    if (output >= 10 && output < 15) wanted.force = 100.0;
    if (output == 20) wanted.damping = 100.0;
    if (output == 25) wanted.damping = 20.0 * (1 + 1e-15);  // what the brake can make, rounded on the way
  });
  const servo_summary summary = run(40);
  EXPECT_EQ(summary.motor_clipped, 5u);
  EXPECT_EQ(summary.brake_clipped, 1u);
  EXPECT_NE(to_text(summary).find("clipped   5 commands at the motor's limit, 1 at the brake's"), std::string::npos);
  EXPECT_EQ(summary.largest_force, 100);
  EXPECT_EQ(summary.largest_damping, 100);
}

// Broken, nobody would know that the law let go of what the motor cannot make, and how much of it.
TEST_F(ServoLoop, CountsWhatTheModelSheds) {
  model.on_share([](std::size_t output) { return output >= 10 && output < 15 ? 0.5 : output == 20 ? 0.25 : 1.0; });
  const servo_summary summary = run(40);
  EXPECT_EQ(summary.shed, 6u);
  EXPECT_EQ(summary.least_share, 0.25);
  EXPECT_EQ(summary.motor_clipped + summary.brake_clipped, 0u);
  EXPECT_NE(to_text(summary).find("shed      6 commands were beyond the motor; the forces were scaled down to 0.25"),
            std::string::npos);
  EXPECT_EQ(to_text(run(40)).find("shed"), std::string::npos);  // from its 41st output on
}

// Broken, a motor at its limit for as long as somebody presses would not count as saturated where the law sheds.
TEST_F(ServoLoop, SheddingForTooLongIsASaturation) {
  model.on_share([](std::size_t) { return 0.5; });
  EXPECT_EQ(run(40).faults.of(fault::motor_saturated), 1u);
}

// Broken, a log that a full disk cut short would look complete.
TEST_F(ServoLoop, TellsThatTheTableIsIncomplete) {
  options.outputs.csv = std::fopen("/dev/full", "w");
  ASSERT_NE(options.outputs.csv, nullptr);
  EXPECT_EQ(run(40).telemetry_error, ENOSPC);
  std::fclose(options.outputs.csv);
}

struct held_law {
  unsigned delay_samples;
  energy_policy policy;
};

// Broken, the energy of the summary would not be the sum over holds of force times displacement plus what the brake
// took, of the commands that were in effect.
TEST_F(ServoLoop, CountsTheEnergyOfEveryHold) {
  for (const held_law law :
       {held_law{0, energy_policy::observe}, held_law{2, energy_policy::observe}, held_law{16, energy_policy::observe},
        held_law{64, energy_policy::observe}, held_law{16, energy_policy::raise_brake},
        held_law{0, energy_policy::raise_brake}, held_law{2, energy_policy::raise_brake}}) {
    device_description ideal = scripted_description();
    ideal.encoder.step = 0;
    ideal.loop.delay_samples = law.delay_samples;
    restart_parts();
    device = scripted_device(ideal);
    options.command.energy = law.policy;
    std::vector<double> positions;
    device.on_read([&](std::size_t read, device_sample& sample) {
      sample.position = 0.02 * std::sin(0.01 * static_cast<double>(read));
      positions.push_back(sample.position);
      return device_status::ok;
    });
    const servo_summary summary = run(400);
    double energy = 0;
    for (std::size_t k = law.delay_samples; k + 1 < 400; ++k) {
      const double moved = positions[k + 1] - positions[k];
      const actuation& held = device.written()[k - law.delay_samples];
      // While the first command holds, the coil rises from nothing, of which nothing is certain.
      const double damping = k == law.delay_samples ? 0 : held.brake_damping;
      energy += -held.motor_torque * moved + damping * moved * moved / 0.001;
    }
    EXPECT_NEAR(summary.energy, energy, 1e-12 * std::abs(energy)) << law.delay_samples;
  }
}

// Broken, the brake's coil would be taken for empty after it has carried the safe command, or for full when it has not.
TEST_F(ServoLoop, KnowsTheCoilFromTheSafeCommandBefore) {
  options.start_running = false;
  const auto one_step_aside = [](std::size_t read, device_sample& sample) {
    sample.position = read > 20 ? 0.001 : 0.0;
    return device_status::ok;
  };
  device.on_read(one_step_aside);
  model.on_output([](std::size_t, command<double>& wanted) { wanted = {7.5, 0.0}; });
  const servo_summary summary = run(22, [](std::size_t write, servo_control& control) {
    if (write == 19) control.start();
  });
  // b Δu²/Δt over the one hold that was observed, Δu known to less than one step of the encoder.
  EXPECT_NEAR(summary.energy, 7.5 * 0.00099 * 0.00099 / 0.001, 1e-15);
}

// Broken, a coil that goes on falling while no sample comes would be credited with what it had at first.
TEST_F(ServoLoop, CreditsTheBrakeOverAGapWithItsLeastDamping) {
  device_description lagging = scripted_description();
  lagging.encoder.step = 0;
  lagging.brake.coil_lag = 0.001;
  device = scripted_device(lagging);
  device.on_read([](std::size_t read, device_sample& sample) {
    sample.position = read == 24 ? 0.001 : 0.0;
    return read > 20 && read < 24 ? device_status::no_data : device_status::ok;
  });
  model.on_output([](std::size_t output, command<double>& wanted) { wanted = {output < 20 ? 15.0 : 0.0, 0.0}; });
  const servo_summary summary = run(25);
  brake_coil<double> coil(lagging.brake);
  for (int period = 0; period < 24; ++period) coil.advance(period < 20 ? std::sqrt(15.0) : 0.0, 0.001);
  EXPECT_NEAR(summary.energy, coil.damping() * 0.001 * 0.001 / 0.004, 1e-12 * summary.energy);
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

// Broken, a command that the stream could not take would end the run at once, or go on being lost for ever.
TEST_F(ServoLoop, LostCommandsAreToleratedLikeMissedDeadlines) {
  device.on_write([](std::size_t write) {
    const bool lost = (write >= 10 && write < 13) || (write >= 20 && write < 24);
    return lost ? device_status::stale : device_status::ok;
  });
  const servo_summary summary = run(40);
  EXPECT_EQ(summary.faults.of(fault::device_error), 1u);
  for (std::size_t k = 0; k < 40; ++k) EXPECT_EQ(is_safe(k), k >= 24) << k;
}

// A spring of 40 N/m in single precision.
struct float_spring {
  using scalar = float;
  static constexpr scalar sample_period = 0.001F;
  static constexpr motion port_motion = motion::translation;
  using certified_for = generated::second_order_maxwell::certified_for;
  void reset(float position) noexcept { position_ = position; }
  command<float> output(float position, float) noexcept { return {3.0F, 40.0F * (position_ = position)}; }
  void update() noexcept {}
  float stored_energy() const noexcept { return 20.0F * position_ * position_; }

 private:
  float position_ = 0;  // [m]
};

// Broken, energy that comes out of springs that were pressed before the run would be told as made from nothing.
TEST(ServoLoopScalar, TellsWhatTheSpringsHeldAtTheStart) {
  scripted_device device;
  device.on_read([](std::size_t, device_sample& sample) {
    sample.position = 0.002;
    return device_status::ok;
  });
  float_spring model;
  any_estimator<float> estimator(device.description().velocity, 0.001, device.description().encoder.step);
  servo_options options;
  options.duration = 0.01;
  options.outputs.log = nullptr;
  servo_summary summary = servo_loop(model, device, estimator, options, simulated_clock{}).run();
  EXPECT_NEAR(summary.stored_at_start, 20 * 0.002 * 0.002, 1e-10);
  summary.lowest_energy = -0.9 * summary.stored_at_start;
  EXPECT_NE(to_text(summary).find("no more than that came out\n"), std::string::npos) << to_text(summary);
  summary.lowest_energy = -1.1 * summary.stored_at_start;
  EXPECT_NE(to_text(summary).find("beyond that the tool may have got more than it gave"), std::string::npos);
}

// Broken, a model in single precision could not run, or its numbers would be rounded twice on their way.
TEST(ServoLoopScalar, FloatModelAndEstimatorRun) {
  scripted_device device, same_motion;
  float_spring model;
  any_estimator<float> estimator(device.description().velocity, 0.001, device.description().encoder.step);
  servo_options options;
  options.duration = 0.1;
  options.outputs.log = nullptr;
  EXPECT_TRUE(servo_loop(model, device, estimator, options, simulated_clock{}).run().left_safe);
  for (std::size_t k = 0; k < 100; ++k) {
    device_sample sample;
    same_motion.read(sample);
    EXPECT_EQ(device.written()[k].motor_torque, -double(40.0F * static_cast<float>(sample.position))) << k;
  }
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

// Broken, Ctrl-C or a closed terminal would kill the process with the motor on, or go on asking a loop that is gone.
TEST(StopOnSignals, AsksTheLoopToStopAndGivesTheHandlersBack) {
  struct sigaction before {};
  sigaction(SIGINT, nullptr, &before);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
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

// Broken, a closed pipe or a full file anywhere in the process would end it with the motor on.
TEST(StopOnSignals, TakesFailedWritesForNoReasonToEnd) {
  struct sigaction before {
  }, after{};
  sigaction(SIGXFSZ, nullptr, &before);
  {
    servo_control control;
    const stop_on_signals guard(control);
    std::raise(SIGXFSZ);
    std::raise(SIGPIPE);
    EXPECT_FALSE(control.stop_requested());
  }
  sigaction(SIGXFSZ, nullptr, &after);
  EXPECT_EQ(after.sa_handler, before.sa_handler);
}

// Broken, a loop whose log nobody reads could not be ended by hand; or it would be, before its device is safe.
TEST(StopOnSignalsDeathTest, SecondSignalEndsTheProcessOnceTheDeviceIsSafe) {
  servo_control control;
  const auto interrupted_twice = [&] {
    const stop_on_signals guard(control);
    control.take_device();
    std::raise(SIGINT);
    std::raise(SIGINT);
    std::fputs("still driving", stderr);
    std::fflush(stderr);
    control.leave_device();
    std::exit(0);
  };
  EXPECT_EXIT(interrupted_twice(), testing::KilledBySignal(SIGINT), "still driving");
  const auto hanging_after_the_device = [&] {
    const stop_on_signals guard(control);
    std::raise(SIGTERM);
    std::raise(SIGTERM);
    std::exit(0);
  };
  EXPECT_EXIT(hanging_after_the_device(), testing::KilledBySignal(SIGTERM), "");
  const auto hanging_with_the_device = [&] {
    const stop_on_signals guard(control);
    control.take_device();
    for (int i = 0; i < 3; ++i) std::raise(SIGINT);
    std::exit(0);
  };
  EXPECT_EXIT(hanging_with_the_device(), testing::KilledBySignal(SIGINT), "");
}

// Broken, a loop that was started under nohup would end with its terminal.
TEST(StopOnSignals, LeavesAHangupIgnored) {
  const auto before = std::signal(SIGHUP, SIG_IGN);
  servo_control control;
  {
    const stop_on_signals guard(control);
    std::raise(SIGHUP);
  }
  EXPECT_FALSE(control.stop_requested());
  EXPECT_EQ(std::signal(SIGHUP, before), SIG_IGN);
}

}  // namespace
}  // namespace dashpot::tests
