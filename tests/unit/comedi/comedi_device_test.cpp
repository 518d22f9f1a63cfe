// The driver of data-acquisition cards against a fake that records every call of Comedi's library.
#include <dashpot/comedi/comedi_device.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <limits>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>

#include "fake_card.hpp"

namespace dashpot::tests {
namespace {

using calls = std::vector<std::string>;

static_assert(check_device<comedi_device>());

device_description rig() {
  device_description facts;
  facts.encoder = {1e-5, quantiser::floor, -0.1, 0.1, 2.0};
  facts.motor.torque_constant = 4;  // [N/A]
  facts.motor.max_torque = 8;       // [N]: 2 A, 4 V
  facts.brake = {brake_kind::eddy_current, 18};
  facts.brake.damping_per_current_squared = 2;  // 18 N·s/m: 3 A, 6 V
  facts.brake.safe_damping = 2;                 // 1 A, 2 V
  return facts;
}

comedi_wiring wires() {
  comedi_wiring wiring;
  wiring.counter = {2, 0, false, 0};
  wiring.motor = {1, 0, 0, AREF_GROUND, 0.5};
  wiring.brake = {1, 1, 0, AREF_GROUND, 0.5};
  return wiring;
}

// Of 16 bits over ±10 V.
std::string sample_of(double voltage) { return std::to_string(std::lround((voltage + 10) / 20 * 0xFFFF)); }

std::string written(double motor, double brake) {
  return "list: write 1/0=" + sample_of(motor) + " write 1/1=" + sample_of(brake);
}

class Comedi : public ::testing::Test {
 protected:
  Comedi() { card() = {}; }

  std::string refusal(const comedi_wiring& wiring, const device_description& facts) {
    std::string error;
    card().calls.clear();
    comedi_device device(wiring, facts);
    EXPECT_FALSE(device.start(error));
    EXPECT_EQ(device.write({1, 1}), device_status::disconnected);
    EXPECT_STRNE(device.cause(), "");
    const auto closed = std::count(card().calls.begin(), card().calls.end(), "close");
    const auto opened = std::count(card().calls.begin(), card().calls.end(), "open /dev/comedi0");
    EXPECT_EQ(closed, card().is_there ? opened : 0);
    card().calls.clear();
    return error;
  }
};

// Fails if a cycle takes other calls than it has to, or motor and brake get other volts than they need.
TEST_F(Comedi, SendsAtOnceWithoutADelay) {
  std::string error;
  comedi_device device(wires(), rig());
  ASSERT_TRUE(device.start(error)) << error;
  EXPECT_EQ(card().take_calls(), (calls{"open /dev/comedi0", written(0, 2) + " read 2/0"}));
  device_sample sample;
  card().counts = 250;
  EXPECT_EQ(device.read(sample), device_status::ok);
  EXPECT_EQ(card().take_calls(), calls{"list: read 2/0"});
  EXPECT_DOUBLE_EQ(sample.position, 2.5e-3);
  EXPECT_EQ(sample.counts, 250);
  EXPECT_EQ(sample.sequence, 1u);
  EXPECT_EQ(sample.report.applied.brake_damping, 2);
  EXPECT_EQ(device.write({-6, 8}), device_status::ok);
  EXPECT_EQ(card().take_calls(), calls{written(-3, 4)});
  device.close();
  EXPECT_EQ(card().take_calls(), (calls{written(0, 2), "close"}));
  EXPECT_EQ(device.read(sample), device_status::disconnected);
}

// Fails if a device with a delay takes more than one list a cycle, or what ends a loop waits for a cycle that never
// comes.
TEST_F(Comedi, TakesOneListACycleWithADelay) {
  device_description facts = rig();
  facts.loop.delay_samples = 1;
  std::string error;
  {
    comedi_device device(wires(), facts);
    ASSERT_TRUE(device.start(error)) << error;
    card().calls.clear();
    device_sample sample;
    device.read(sample);
    EXPECT_EQ(card().take_calls(), calls{"list: read 2/0"});
    EXPECT_EQ(device.write({6, 8}), device_status::ok);
    EXPECT_EQ(card().take_calls(), calls{});
    EXPECT_EQ(sample.report.applied.motor_torque, 0);
    device.read(sample);
    EXPECT_EQ(card().take_calls(), calls{written(3, 4) + " read 2/0"});
    EXPECT_EQ(sample.report.applied.motor_torque, 6);
    device.write({4, 8});
    EXPECT_EQ(device.write({0, 2}), device_status::ok);
    EXPECT_EQ(card().take_calls(), calls{written(0, 2)});
    device.read(sample);
    EXPECT_EQ(card().take_calls(), calls{"list: read 2/0"});
    device.write({6, 8});
  }
  EXPECT_EQ(card().take_calls(), (calls{written(0, 2), "close"}));
}

// Fails if more than the limits reaches the amplifiers, or a damping below zero the root.
TEST_F(Comedi, KeepsToTheLimits) {
  std::string error;
  comedi_device device(wires(), rig());
  ASSERT_TRUE(device.start(error)) << error;
  card().calls.clear();
  device.write({100, 100});
  device.write({-100, -1});
  EXPECT_EQ(card().take_calls(), (calls{written(4, 6), written(-4, 0)}));
  device_sample sample;
  device.read(sample);
  EXPECT_EQ(sample.report.applied.motor_torque, -8);
  EXPECT_EQ(sample.report.applied.brake_damping, 0);
}

// Fails if a position jumps where the counter wraps around, either way, or where it counts down from the start.
TEST_F(Comedi, FollowsTheCounterOverItsEnds) {
  for (const unsigned most : {0xFFFFu, 0xFFFFFFu, 0xFFFFFFFFu}) {
    card().most_counts = most;
    card().counts = 5;
    std::string error;
    device_description facts = rig();
    facts.encoder.max_speed = 0.5;
    comedi_device device(wires(), facts);
    ASSERT_TRUE(device.start(error)) << error;
    device_sample sample;
    for (const auto& [counts, position] : {std::pair(most - 4, -10), {most - 4000, -4006}, {2u, -3}, {7000u, 6995}}) {
      card().counts = counts;
      device.read(sample);
      EXPECT_EQ(sample.counts, position) << most;
    }
  }
}

// Fails if a card that refuses is driven on, or is not asked for the safe command, or the loop is not told why.
TEST_F(Comedi, MakesSafeWhatFails) {
  std::string error;
  comedi_device device(wires(), rig());
  ASSERT_TRUE(device.start(error)) << error;
  device_sample sample;
  device.write({6, 8});
  card().calls.clear();
  card().failing_subdevice = 2;
  card().failure = EIO;
  EXPECT_EQ(device.read(sample), device_status::fault);
  EXPECT_STREQ(device.cause(), "the card refuses to read its counter");
  EXPECT_EQ(card().take_calls(), (calls{"list: failed", written(0, 2)}));
  card().failure = ENODEV;
  EXPECT_EQ(device.read(sample), device_status::disconnected);
  card().failing_subdevice = 1;
  EXPECT_EQ(device.write({1, 1}), device_status::disconnected);
  card().failing_subdevice = std::nullopt;
  card().calls.clear();
  for (const double no_number : {double(NAN), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(device.write({no_number, 1}), device_status::fault);
    EXPECT_EQ(device.write({1, no_number}), device_status::fault);
  }
  EXPECT_EQ(card().take_calls(), calls(4, written(0, 2)));
}

// Fails if a card, a wiring or a description that does not fit moves anything, or is refused without a remedy.
TEST_F(Comedi, RefusesWhatDoesNotFit) {
  const auto with = [](auto change) {
    device_description facts = rig();
    change(facts);
    return facts;
  };
  card().is_there = false;
  EXPECT_EQ(refusal(wires(), rig()), "cannot open '/dev/comedi0': No such file or directory");
  card().is_there = true;
  comedi_wiring wiring = wires();
  wiring.motor.subdevice = 0;
  EXPECT_EQ(refusal(wiring, rig()),
            "the motor is wired to subdevice 0, channel 0 of '/dev/comedi0', which is no analogue output");
  wiring = wires();
  wiring.brake.range = 1;
  EXPECT_NE(refusal(wiring, rig()).find("which has no range 1"), std::string::npos);
  wiring = wires();
  wiring.counter.subdevice = 1;
  EXPECT_EQ(refusal(wiring, rig()), "subdevice 1 of '/dev/comedi0' is no counter");
  wiring = wires();
  wiring.motor.current_per_volt = 0.1;
  EXPECT_NE(refusal(wiring, rig()).find("max_torque needs +-20 V, and the motor's output has -10 to 10 V"),
            std::string::npos);
  wiring = wires();
  wiring.brake.current_per_volt = 0.2;
  EXPECT_NE(refusal(wiring, rig()).find("a damping of 18 needs 15 V"), std::string::npos);
  EXPECT_NE(refusal(wires(), with([](auto& d) { d.motor.torque_constant = 0; })).find("state torque_constant"),
            std::string::npos);
  EXPECT_NE(refusal(wires(), with([](auto& d) { d.motor.max_torque = 0; })).find("no max_torque"), std::string::npos);
  EXPECT_NE(refusal(wires(), with([](auto& d) { d.encoder.step = 0; })).find("no encoder resolution"),
            std::string::npos);
  EXPECT_NE(refusal(wires(), with([](auto& d) { d.loop.delay_samples = 2; })).find("0, or 1"), std::string::npos);
  EXPECT_NE(
      refusal(wires(), with([](auto& d) { d.brake.damping_per_current_squared = 0; })).find("or measured brake_points"),
      std::string::npos);
  card().most_counts = 0xFF;
  EXPECT_NE(refusal(wires(), rig()).find("the counter wraps at 256 counts; at max_speed 800 pass"), std::string::npos);
  card().most_counts = 0xFFFFFF;
  card().output_range = {0.004, 0.02, UNIT_mA};
  EXPECT_NE(refusal(wires(), rig()).find("not one in volts that holds 0"), std::string::npos);
  card().output_range = {-10, 10, UNIT_volt};
  card().refuses_mode = true;
  wiring = wires();
  wiring.counter.is_configured = true;
  EXPECT_NE(refusal(wiring, rig()).find("the counter does not take its mode"), std::string::npos);
  card().failing_subdevice = 2;
  EXPECT_NE(refusal(wires(), rig()).find("refuses to read and write"), std::string::npos);
}

// Fails if the counter is armed before it has its mode.
TEST_F(Comedi, SetsUpTheCounterWhereAsked) {
  comedi_wiring wiring = wires();
  wiring.counter = {2, 0, true, 7};
  std::string error;
  comedi_device device(wiring, rig());
  ASSERT_TRUE(device.start(error)) << error;
  EXPECT_EQ(card().take_calls(),
            (calls{"open /dev/comedi0", "reset 2/0", "mode 2/0=7", "arm 2/0", written(0, 2) + " read 2/0"}));
}

// Fails if a measured brake is driven by anything but its points, between them in the root of the damping.
TEST_F(Comedi, FollowsAMeasuredBrake) {
  comedi_wiring wiring = wires();
  wiring.brake_points = {{0.5, 0}, {2.5, 4}, {7.5, 25}};
  std::string error;
  comedi_device device(wiring, rig());
  ASSERT_TRUE(device.start(error)) << error;
  EXPECT_DOUBLE_EQ(device.voltages({0, 0}).second, 0.5);
  EXPECT_DOUBLE_EQ(device.voltages({0, 1}).second, 1.5);
  EXPECT_DOUBLE_EQ(device.voltages({0, 4}).second, 2.5);
  EXPECT_DOUBLE_EQ(device.voltages({0, 9}).second, 2.5 + 5.0 / 3);
  wiring.brake_points = {{0, 0}, {1, 4}};
  EXPECT_NE(refusal(wiring, rig()).find("end at 4, below the device's max_damping of 18"), std::string::npos);
  wiring.brake_points = {{0, 0}, {3, 4}, {2, 20}};
  EXPECT_NE(refusal(wiring, rig()).find("in voltage go one way"), std::string::npos);
  wiring.brake_points = {{0, 1}, {3, 40}};
  EXPECT_NE(refusal(wiring, rig()).find("begin with a damping of 0"), std::string::npos);
}

// Fails if a device without a brake needs an output for one.
TEST_F(Comedi, NeedsNoBrake) {
  device_description facts = rig();
  facts.brake = {};
  comedi_wiring wiring = wires();
  wiring.brake = {};
  std::string error;
  comedi_device device(wiring, facts);
  ASSERT_TRUE(device.start(error)) << error;
  card().calls.clear();
  device.write({8, 5});
  EXPECT_EQ(card().take_calls(), calls{"list: write 1/0=" + sample_of(4)});
}

// A spring, for the loop to drive.
struct spring {
  using scalar = double;
  static constexpr scalar sample_period = 0.001;
  static constexpr motion port_motion = motion::translation;
  struct certified_for {
    static constexpr bool any_device = true;
    static constexpr const char* device = "ideal";
    static constexpr const char* device_digest = "";
    static constexpr const char* estimator = "exact";
    static constexpr unsigned loop_delay = 0;
  };
  void reset(double) noexcept {}
  command<double> output(double position, double) noexcept { return {8, 100 * position}; }
  void update() noexcept {}
  double stored_energy() const noexcept { return 0; }
};

// Fails if the loop cannot drive a card, or does not leave it safe.
TEST_F(Comedi, IsDrivenByTheLoop) {
  std::string error;
  comedi_device device(wires(), rig());
  ASSERT_TRUE(device.start(error)) << error;
  card().calls.clear();
  spring law;
  any_estimator<double> estimator(rig().velocity, rig().loop.sample_period, rig().encoder.step);
  servo_options options;
  options.duration = 0.05;
  const servo_summary run = servo_loop(law, device, estimator, options, simulated_clock{}).run();
  EXPECT_TRUE(run.left_safe);
  EXPECT_TRUE(run.safe_confirmed);
  EXPECT_EQ(run.faults.total(), 0u);
  EXPECT_GE(std::count(card().calls.begin(), card().calls.end(), written(0, 4)), 49);
  EXPECT_EQ(std::to_string(card().outputs[0]) + " " + std::to_string(card().outputs[1]),
            sample_of(0) + " " + sample_of(2));
}

}  // namespace
}  // namespace dashpot::tests
