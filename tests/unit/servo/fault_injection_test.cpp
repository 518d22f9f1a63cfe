#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <dashpot/servo/servo_loop.hpp>

#include "loop_fixture.hpp"

namespace dashpot::tests {
namespace {

constexpr std::size_t periods = 600;
constexpr unsigned seed = 20090615;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

struct rig {
  scripted_device device;
  scripted_model model;
  scripted_estimator estimator;
  scripted_clock clock;
};

struct outcome {
  servo_summary summary;
  std::vector<actuation> written;
  std::vector<telemetry_record> records;
  std::string log;
};

// A way to go wrong at read `instant`, and the number of periods after it that pass before it is a fault.
struct scenario {
  const char* name;
  fault kind;
  unsigned tolerated;
  std::function<void(rig&, std::size_t instant)> prepare;
};

void PrintTo(const scenario& which, std::ostream* out) { *out << which.name; }

outcome run(rig& parts) {
  outcome result;
  log_text log;
  servo_options options;
  options.duration = 0.001 * static_cast<double>(periods);
  options.telemetry_capacity = 64;
  options.outputs.log = log.file();
  options.outputs.observe = [&result](const telemetry_record& record) { result.records.push_back(record); };
  servo_loop loop(parts.model, parts.device, parts.estimator, options, parts.clock);
  result.summary = loop.run();
  result.written = parts.device.written();
  result.log = log.text();
  return result;
}

// `disturb` is called for read `instant` alone, or for all from there on.
void disturb_once(rig& parts, std::size_t instant, std::function<device_status(device_sample&)> disturb) {
  parts.device.on_read([instant, disturb](std::size_t read, device_sample& sample) {
    return read == instant ? disturb(sample) : device_status::ok;
  });
}
void disturb_from(rig& parts, std::size_t instant, std::function<device_status(device_sample&)> disturb) {
  parts.device.on_read([instant, disturb](std::size_t read, device_sample& sample) {
    return read >= instant ? disturb(sample) : device_status::ok;
  });
}

scenario position_becomes(const char* name, fault kind, double position) {
  return {name, kind, 0, [position](rig& parts, std::size_t instant) {
            disturb_once(parts, instant, [position](device_sample& sample) {
              sample.position = position;
              return device_status::ok;
            });
          }};
}

scenario report_becomes(const char* name, actuation applied) {
  return {name, fault::report_not_finite, 0, [applied](rig& parts, std::size_t instant) {
            disturb_from(parts, instant, [applied, instant, &parts](device_sample& sample) {
              const std::vector<actuation>& written = parts.device.written();
              sample.report = {true, 0, written.size() == instant ? applied : written.back()};
              return device_status::ok;
            });
          }};
}

scenario status_becomes(const char* name, fault kind, device_status status) {
  return {name, kind, 0, [status](rig& parts, std::size_t instant) {
            disturb_once(parts, instant, [status](device_sample&) { return status; });
          }};
}

scenario status_stays(const char* name, device_status status) {
  return {name, fault::no_data, 3, [status](rig& parts, std::size_t instant) {
            disturb_from(parts, instant, [status](device_sample&) { return status; });
          }};
}

scenario command_becomes(const char* name, command<double> wanted) {
  return {name, fault::command_not_finite, 0, [wanted](rig& parts, std::size_t instant) {
            parts.model.on_output([=](std::size_t output, command<double>& given) {
              if (output == instant) given = wanted;
            });
          }};
}

scenario velocity_becomes(const char* name, fault kind, double velocity) {
  return {name, kind, 0, [velocity](rig& parts, std::size_t instant) {
            parts.estimator.on_update(
                [=](std::size_t update, double estimate) { return update == instant ? velocity : estimate; });
          }};
}

std::vector<scenario> scenarios() {
  return {
      position_becomes("PositionNaN", fault::position_not_finite, not_a_number),
      position_becomes("PositionInfinite", fault::position_not_finite, -infinity),
      position_becomes("PositionAboveRange", fault::position_out_of_range, 0.1 + 1e-9),
      position_becomes("PositionBelowRange", fault::position_out_of_range, -0.1 - 1e-9),
      {"EncoderJump", fault::encoder_jump, 0,
       [](rig& parts, std::size_t instant) {
         // 2 m/s for a period and the jitter of 0.1 ms make 2.2 mm; the motion itself brings less than 0.5 mm.
         disturb_once(parts, instant, [](device_sample& sample) {
           sample.position += sample.position > 0 ? -0.003 : 0.003;
           return device_status::ok;
         });
       }},
      report_becomes("ReportedTorqueNaN", {not_a_number, 11.0}),
      report_becomes("ReportedDampingInfinite", {0.0, infinity}),
      velocity_becomes("VelocityNaN", fault::velocity_not_finite, not_a_number),
      velocity_becomes("OverspeedForwards", fault::overspeed, 2.0 + 1e-9),
      velocity_becomes("OverspeedBackwards", fault::overspeed, -2.0 - 1e-9),
      status_becomes("DeviceFault", fault::device_error, device_status::fault),
      status_becomes("DeviceDisconnected", fault::device_error, device_status::disconnected),
      status_stays("NoData", device_status::no_data),
      status_stays("Stale", device_status::stale),
      status_stays("Corrupted", device_status::corrupted),
      {"FrozenSequence", fault::no_data, 3,
       [](rig& parts, std::size_t instant) {
         disturb_from(parts, instant, [instant](device_sample& sample) {
           sample.sequence = static_cast<std::uint32_t>(instant);
           return device_status::ok;
         });
       }},
      command_becomes("ForceNaN", {11.0, not_a_number}),
      command_becomes("ForceInfinite", {11.0, infinity}),
      command_becomes("DampingNaN", {not_a_number, 0.0}),
      {"MissedDeadlines", fault::missed_deadlines, 0,
       [](rig& parts, std::size_t instant) { parts.clock.oversleep(instant, 4); }},
      {"Suspended", fault::suspended, 0,
       [](rig& parts, std::size_t instant) { parts.clock.suspend(instant, 500'000); }},
      {"MotorSaturated", fault::motor_saturated, 10,
       [](rig& parts, std::size_t instant) {
         parts.model.on_output([instant](std::size_t output, command<double>& wanted) {
           if (output >= instant) wanted.force = 1000.0;
         });
       }},
  };
}

bool is_safe(const actuation& sent) { return sent.motor_torque == 0 && sent.brake_damping == 7.5; }

const outcome& undisturbed() {
  static const outcome result = [] {
    rig parts;
    return run(parts);
  }();
  return result;
}

class FaultInjection : public testing::TestWithParam<scenario> {
 protected:
  void check(std::size_t instant) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", instant " + std::to_string(instant));
    rig parts;
    GetParam().prepare(parts, instant);
    const outcome result = run(parts);
    check_commands(result.written, instant);
    check_account(result, instant + GetParam().tolerated);
  }

  void check_commands(const std::vector<actuation>& written, std::size_t instant) {
    for (std::size_t k = 0; k < instant; ++k) ASSERT_TRUE(same_bits(written[k], undisturbed().written[k])) << k;
    for (std::size_t k = instant; k < instant + GetParam().tolerated; ++k) ASSERT_FALSE(is_safe(written[k])) << k;
    for (std::size_t k = instant + GetParam().tolerated; k < written.size(); ++k) ASSERT_TRUE(is_safe(written[k])) << k;
  }

  void check_account(const outcome& result, std::size_t tripped) {
    EXPECT_STREQ(name_of(result.summary.state), "safe");
    EXPECT_EQ(result.summary.faults.of(GetParam().kind), 1u);
    EXPECT_EQ(result.summary.faults.total(), 1u);
    EXPECT_TRUE(result.summary.left_safe);
    EXPECT_STREQ(name_of(result.records[tripped].tripped), name_of(GetParam().kind));
    EXPECT_STREQ(name_of(result.records[tripped].state), "safe");
    EXPECT_STREQ(name_of(result.records[tripped - 1].state), "running");
    const std::string line = std::string(": safe: ") + name_of(GetParam().kind) + ": ";
    EXPECT_NE(result.log.find(line), std::string::npos) << result.log;
  }
};

// Broken, a fault would reach the motor, be miscounted, go unnamed, or change what was commanded before it.
TEST_P(FaultInjection, EndsInTheSafeCommandWithinOnePeriod) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::size_t> instants(1, periods - 20);
  for (int repetition = 0; repetition < 100; ++repetition) {
    check(instants(random));
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Every, FaultInjection, testing::ValuesIn(scenarios()),
                         [](const auto& which) { return std::string(which.param.name); });

// Broken, a fault kind could be added without ever being injected.
TEST(FaultInjection, CoversEveryKind) {
  std::vector<bool> covered(fault_kinds);
  for (const scenario& each : scenarios()) covered[static_cast<unsigned>(each.kind)] = true;
  for (unsigned kind = 1; kind < fault_kinds; ++kind) EXPECT_TRUE(covered[kind]) << name_of(static_cast<fault>(kind));
}

// Broken, a command that the device refused would be repeated instead of the safe one, one period later.
TEST(FaultInjection, RefusedWriteIsFollowedByTheSafeCommand) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::size_t> instants(1, periods - 20);
  for (int repetition = 0; repetition < 100; ++repetition) {
    const std::size_t instant = instants(random);
    rig parts;
    parts.device.on_write(
        [=](std::size_t write) { return write == instant ? device_status::fault : device_status::ok; });
    const outcome result = run(parts);
    for (std::size_t k = 0; k <= instant; ++k) ASSERT_TRUE(same_bits(result.written[k], undisturbed().written[k])) << k;
    for (std::size_t k = instant + 1; k < periods; ++k) ASSERT_TRUE(is_safe(result.written[k])) << k;
    EXPECT_EQ(result.summary.faults.of(fault::device_error), 1u);
    EXPECT_EQ(result.summary.faults.total(), 1u);
    EXPECT_NE(result.log.find("device error: the device answers 'fault'"), std::string::npos) << result.log;
  }
}

// Broken, the reference run of all the tests above would itself contain faults and prove nothing.
TEST(FaultInjection, UndisturbedRunHasNoFault) {
  const outcome& result = undisturbed();
  EXPECT_EQ(result.summary.faults.total(), 0u);
  EXPECT_STREQ(name_of(result.summary.state), "running");
  EXPECT_EQ(result.summary.held, 0u);
  EXPECT_EQ(result.summary.motor_clipped + result.summary.brake_clipped, 0u);
  for (std::size_t k = 0; k < periods; ++k) ASSERT_FALSE(is_safe(result.written[k])) << k;
}

}  // namespace
}  // namespace dashpot::tests
