#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>
#include <dashpot/simulated/hand.hpp>
#include <dashpot/simulated/simulated_device.hpp>
#include <dashpot/simulated/trajectory.hpp>

#include "loop_fixture.hpp"

namespace dashpot::tests {
namespace {

using simulated::sample_fault;
using simulated::sample_fault_kind;

constexpr std::size_t run_length = 1000;

// 0.2 kg moved to and fro by a hand; every limit stated, every lag and friction present.
device_description sliding_device() {
  device_description device = scripted_description();
  device.loop.jitter = 0;
  device.velocity.window = 5;
  device.motor.amplifier_lag = 0.0002;
  device.brake.coil_lag = 0.001;
  device.brake.damping_per_current_squared = 4;
  device.brake.residual_damping = 0.05;
  device.brake.tolerance = 0.05;
  device.mechanics = {0.2, 0.1, 0.3};
  return device;
}

simulated::scenario scene_with(std::vector<sample_fault> faults, simulated::brake_gain gain) {
  simulated::scenario scene;
  scene.user = simulated::firm_hand();
  scene.intended = simulated::sine(0.03, 1.5);
  scene.gain = gain;
  scene.seed = 42;
  scene.faults = std::move(faults);
  return scene;
}

struct closed_loop_run {
  servo_summary summary;
  simulated::energy_ledger ledger;
  std::vector<telemetry_record> records;
  std::string table;
};

template <class Model = generated::second_order_maxwell>
closed_loop_run run(const device_description& description, std::vector<sample_fault> faults = {},
                    simulated::brake_gain gain = simulated::brake_gain::drawn) {
  simulated_device device(description, scene_with(std::move(faults), gain));
  Model model;
  any_estimator<double> estimator(description.velocity, 0.001, description.encoder.step);
  closed_loop_run result;
  log_text table;
  servo_options options;
  options.duration = 0.001 * static_cast<double>(run_length);
  options.telemetry_capacity = 256;
  options.outputs.log = nullptr;
  options.outputs.csv = table.file();
  options.outputs.observe = [&result](const telemetry_record& record) { result.records.push_back(record); };
  result.summary = servo_loop(model, device, estimator, options, simulated_clock{}).run();
  result.ledger = device.ledger();
  result.table = table.text();
  return result;
}

// Broken, loop and simulated device would not agree about signs, units or time: the tissue would push the hand away.
TEST(SimulatedLoop, RunsWithoutFaultAndTheSameEveryTime) {
  const closed_loop_run first = run(sliding_device()), second = run(sliding_device());
  EXPECT_EQ(first.summary.faults.total(), 0u);
  EXPECT_EQ(first.summary.held, 0u);
  EXPECT_EQ(first.records.size(), run_length);
  EXPECT_EQ(first.table, second.table);
  EXPECT_GT(first.ledger.brake, 0.01);
}

// A brake that goes up and down by a factor of ten, so that its coil never settles.
struct pulsing_brake : generated::second_order_maxwell {
  command<double> output(double position, double velocity) noexcept {
    const command<double> wanted = second_order_maxwell::output(position, velocity);
    return {++outputs_ % 14 < 7 ? 1.5 : 15.0, wanted.force};
  }

 private:
  unsigned outputs_ = 0;
};

std::vector<sample_fault> many_losses() {
  std::vector<sample_fault> losses;
  for (std::uint64_t first = 5; first + 5 < run_length; first += 11)
    losses.push_back({sample_fault_kind::lost, first, 3, 0});
  return losses;
}

// Broken, the energy that the loop claims to have taken from the tool would exceed what motor and brake really took,
// above all where the coil moves on while no sample comes.
TEST(SimulatedLoop, CountsNoMoreEnergyThanWasTaken) {
  device_description device = sliding_device();
  device.encoder.step = 0;         // an encoder's step moves the motor's part by a stated amount,
  device.motor.amplifier_lag = 0;  // and the observer does not see the amplifier
  for (const std::vector<sample_fault>& faults : {std::vector<sample_fault>(), many_losses()}) {
    const closed_loop_run result = run<pulsing_brake>(device, faults, simulated::brake_gain::lowest);
    EXPECT_EQ(result.summary.faults.total(), 0u);
    EXPECT_EQ(result.summary.held, 3 * faults.size());
    EXPECT_LE(result.summary.energy, result.ledger.brake - result.ledger.motor);
  }
}

// Broken, the loop would count far less than was taken, and so prove nothing by it.
TEST(SimulatedLoop, CountsNearlyAllEnergyThatWasTaken) {
  device_description device = sliding_device();
  device.encoder.step = 0;
  device.motor.amplifier_lag = 0;
  const closed_loop_run result = run(device);
  const double taken = result.ledger.brake - result.ledger.motor;
  EXPECT_LE(result.summary.energy, taken);
  // The brake is credited at the low end of its tolerance and may be at the high end: 10 %; its residual damping, which
  // is not credited, is 0.5 % of the 11 N·s/m; a hold of 1 ms leaves nothing of the order of a percent.
  EXPECT_GT(result.summary.energy, taken - 0.11 * result.ledger.brake);
}

struct strike {
  const char* name;
  sample_fault_kind kind;
  std::uint64_t count;
  double size;
  fault expected;
};

void PrintTo(const strike& which, std::ostream* out) { *out << which.name; }

class SimulatedFault : public testing::TestWithParam<strike> {};

// Broken, a fault in a closed loop would reach the motor, or change what was commanded before it.
TEST_P(SimulatedFault, EndsInTheSafeCommandAndChangesNothingBefore) {
  const closed_loop_run sound = run(sliding_device());
  constexpr unsigned seed = 3;
  std::mt19937 random(seed);
  for (int repetition = 0; repetition < 10; ++repetition) {
    const std::uint64_t instant = std::uniform_int_distribution<std::uint64_t>(1, run_length - 20)(random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", instant " + std::to_string(instant));
    const closed_loop_run struck =
        run(sliding_device(), {{GetParam().kind, instant, GetParam().count, GetParam().size}});
    for (std::size_t k = 0; k < instant; ++k) ASSERT_EQ(csv_row(struck.records[k]), csv_row(sound.records[k]));
    for (std::size_t k = instant + GetParam().count - 1; k < run_length; ++k) {
      ASSERT_EQ(struck.records[k].motor_torque, 0) << k;
      ASSERT_EQ(struck.records[k].brake_damping, 7.5) << k;
    }
    EXPECT_EQ(struck.summary.faults.of(GetParam().expected), 1u);
    EXPECT_EQ(struck.summary.faults.total(), 1u);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Every, SimulatedFault,
    testing::Values(strike{"Lost", sample_fault_kind::lost, 4, 0, fault::no_data},
                    strike{"Repeated", sample_fault_kind::repeated, 4, 0, fault::no_data},
                    strike{"Corrupted", sample_fault_kind::corrupted, 4, 0, fault::no_data},
                    strike{"Disconnected", sample_fault_kind::disconnected, 1, 0, fault::device_error},
                    strike{"DeviceError", sample_fault_kind::device_error, 1, 0, fault::device_error},
                    strike{"NotANumber", sample_fault_kind::not_a_number, 1, 0, fault::position_not_finite},
                    strike{"Jump", sample_fault_kind::jump, 1, 0.004, fault::encoder_jump}),
    [](const auto& which) { return std::string(which.param.name); });

// Broken, three lost samples, which the device allows, would end the run or be felt as a jump of the command.
TEST(SimulatedLoop, ThreeLostSamplesAreHeldThroughAndSmoothlyLeft) {
  const closed_loop_run sound = run(sliding_device());
  const closed_loop_run gapped = run(sliding_device(), {{sample_fault_kind::lost, 400, 3, 0}});
  EXPECT_EQ(gapped.summary.faults.total(), 0u);
  EXPECT_EQ(gapped.summary.held, 3u);
  EXPECT_EQ(gapped.records[402].motor_torque, gapped.records[399].motor_torque);
  // What differs is a hold of 3 ms; unfilled, the gap would look like four times the velocity, more than 3 N.
  EXPECT_NEAR(gapped.records[403].motor_torque, sound.records[403].motor_torque, 0.1);
}

}  // namespace
}  // namespace dashpot::tests
