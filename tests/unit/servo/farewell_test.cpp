// How a loop takes leave of its device, whatever the device makes of it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "loop_fixture.hpp"

namespace dashpot::tests {
namespace {

// A scripted device that tells what it applies, as a board does: what was written before the last read.
class telling_device : public scripted_device {
 public:
  explicit telling_device(const device_description& description) : scripted_device(description) {}

  device_status read(device_sample& sample) noexcept {
    const device_status status = scripted_device::read(sample);
    if (silent_from <= reads()) return device_status::no_data;
    if (written().size() > deaf_for) sample.report = {true, deaf_for, written()[written().size() - 1 - deaf_for]};
    if (strength < 1) sample.report.applied.motor_torque *= strength;
    return status;
  }

  unsigned deaf_for = 0;  // it obeys commands so many writes late
  double strength = 1;
  std::size_t silent_from = ~std::size_t{0};
};

struct run_of {
  servo_summary summary;
  std::string log;
};

run_of run(telling_device& device, double duration = 0.05, double farewell = servo_options().farewell) {
  scripted_model model;
  scripted_estimator estimator;
  log_text log;
  servo_options options;
  options.duration = duration;
  options.farewell = farewell;
  options.outputs.log = log.file();
  run_of result;
  result.summary = servo_loop(model, device, estimator, options, scripted_clock{}).run();
  result.log = log.text();
  return result;
}

// Broken, "device left safe" would be said of a command that is still on its way, or lost.
TEST(Farewell, IsConfirmedByASample) {
  for (const unsigned late : {0u, 5u, 40u}) {
    telling_device device(scripted_description());
    device.deaf_for = late;
    const servo_summary summary = run(device).summary;
    EXPECT_TRUE(summary.left_safe && summary.safe_confirmed);
    EXPECT_EQ(device.written().size(), 50u + late + 1) << "the safe command goes on until it is confirmed";
    EXPECT_NE(to_text(summary).find("ended     running, device left safe\n"), std::string::npos) << to_text(summary);
  }
}

// Broken, a run that is stopped after its first period would not know that the device can confirm, and would not wait.
TEST(Farewell, IsConfirmedAfterOnePeriodToo) {
  telling_device device(scripted_description());
  const servo_summary summary = run(device, 0.001).summary;
  EXPECT_EQ(device.written().size(), 2u);
  EXPECT_NE(to_text(summary).find("ended     running, device left safe\n"), std::string::npos) << to_text(summary);
}

// Broken, a device that has stopped talking would be called safe because the stream took the command.
TEST(Farewell, MissingConfirmationIsReported) {
  telling_device device(scripted_description());
  device.silent_from = 51;
  const servo_summary summary = run(device).summary;
  EXPECT_FALSE(summary.left_safe);
  EXPECT_NE(to_text(summary).find("safe command sent, NOT confirmed by the device"), std::string::npos);
  EXPECT_EQ(device.written().size(), 50u + 501) << "half a second long";
}

// Broken, a slow link could not be given more time, or a wait of NaN seconds would be for ever.
TEST(Farewell, WaitsAsLongAsItIsTold) {
  for (const double farewell : {0.5, 1.0}) {
    telling_device slow(scripted_description());
    slow.deaf_for = 900;
    EXPECT_EQ(run(slow, 1, farewell).summary.safe_confirmed, farewell == 1);
  }
  for (const double none : {0.0, -1.0, std::nan("")}) {
    telling_device silent(scripted_description());
    silent.silent_from = 51;
    EXPECT_FALSE(run(silent, 0.05, none).summary.left_safe);
    EXPECT_EQ(silent.written().size(), 50u + 1);
  }
}

// Broken, a device that never tells anything would be called confirmed.
TEST(Farewell, OfADeviceThatCannotConfirmSaysThat) {
  scripted_device device;
  scripted_model model;
  scripted_estimator estimator;
  servo_options options;
  options.duration = 0.05;
  options.outputs.log = nullptr;
  const servo_summary summary = servo_loop(model, device, estimator, options, scripted_clock{}).run();
  EXPECT_TRUE(summary.left_safe);
  EXPECT_FALSE(summary.safe_confirmed);
  EXPECT_NE(to_text(summary).find("device given the safe command, which it cannot confirm"), std::string::npos);
}

// Broken, a device file that allows 100,000 missed deadlines would make a loop on a dead board that goes on for minutes
// after Ctrl-C, and past its time.
TEST(Farewell, FromADeadDeviceEndsDespiteManyAllowedMisses) {
  for (const unsigned allowed : {100'000u, 100'000'000u}) {
    device_description patient = scripted_description();
    patient.loop.missed_deadlines_allowed = allowed;
    scripted_device device(patient);
    device.on_read(
        [](std::size_t read, device_sample&) { return read > 10 ? device_status::no_data : device_status::ok; });
    device.on_write([](std::size_t write) { return write > 10 ? device_status::stale : device_status::ok; });
    scripted_model model;
    scripted_estimator estimator;
    servo_options options;
    options.duration = 0.05;
    options.outputs.log = nullptr;
    EXPECT_FALSE(servo_loop(model, device, estimator, options, scripted_clock{}).run().left_safe);
    EXPECT_LE(device.written().size(), 50u + 501);
  }
}

// Broken, one sequence number beyond reason would hold up the command of that period for as long as a loop over a
// hundred million periods takes.
TEST(WildSequenceNumber, CostsNoMoreThanALongWindow) {
  device_description patient = scripted_description();
  patient.loop.missed_deadlines_allowed = 100'000'000;
  scripted_device device(patient);
  device.on_read([](std::size_t read, device_sample& sample) {
    if (read >= 20) sample.sequence += 99'999'000;
    return device_status::ok;
  });
  scripted_model model;
  scripted_estimator estimator;
  std::size_t updates = 0, most = 0, before = 0;
  estimator.on_update([&](std::size_t, double velocity) { return ++updates, velocity; });
  model.on_output([&](std::size_t, command<double>&) { most = std::max(most, updates - before), before = updates; });
  servo_options options;
  options.duration = 0.05;
  options.outputs.log = nullptr;
  const servo_summary summary = servo_loop(model, device, estimator, options, scripted_clock{}).run();
  EXPECT_EQ(summary.faults.total(), 0u);
  EXPECT_EQ(most, 256u);
}

// Broken, a board that clips in spite of what it promised would be told nowhere, and the energy would be that of a
// motor which is not there: asked for 0.5 N, 0.1 N applied, "0 commands at the motor's limit".
TEST(WeakDevice, IsToldAndReckonedWith) {
  device_description ideal = scripted_description();
  ideal.encoder.step = 0;
  ideal.brake = {};
  ideal.loop.delay_samples = 1;
  ideal.motor = {};
  telling_device device(ideal);
  device.strength = 0.2;
  std::vector<double> positions;
  device.on_read([&](std::size_t read, device_sample& sample) {
    sample.position = 0.02 * std::sin(0.05 * static_cast<double>(read));
    positions.push_back(sample.position);
    return device_status::ok;
  });
  const servo_summary summary = run(device, 0.4).summary;
  EXPECT_GT(summary.motor_clipped, 390u);
  double truth = 0;
  for (std::size_t k = 1; k + 1 < 400; ++k)
    truth -= 0.2 * device.written()[k - 1].motor_torque * (positions[k + 1] - positions[k]);
  EXPECT_NEAR(summary.energy, truth, 1e-12);
}

// Broken, the one number that says what clips would be shown as if all were well.
TEST(WeakDevice, GoesSafeAfterTheSaturationThatIsAllowed) {
  telling_device device(scripted_description());
  device.strength = 0.2;
  const run_of result = run(device);
  EXPECT_EQ(result.summary.faults.of(fault::motor_saturated), 1u);
  EXPECT_NE(result.log.find("safe: motor saturated"), std::string::npos) << result.log;
}

}  // namespace
}  // namespace dashpot::tests
