// Host and firmware with every counter just before its wrap: what works for an hour must work after weeks.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>

#include "stepped_session.hpp"

namespace dashpot::uptime_test {
namespace {

using namespace board;

constexpr std::uint32_t periods = 10'000;
constexpr std::uint64_t period = 1'000'000;                  // [ns]
constexpr std::uint32_t shortly = 5'000;                     // before the wrap [periods]
constexpr std::uint32_t last_numbers = 0U - shortly;         // of samples and commands
constexpr std::uint64_t last_times = 0U - shortly * period;  // of both clocks [ns]
constexpr board_age aged = {std::numeric_limits<std::int32_t>::max() - 100, last_times};

board_options numbered_from(std::uint32_t number, sampling when, controller who = controller::host) {
  board_options options;
  options.first_command = number;
  options.sampling = when;
  options.controller = who;
  return options;
}

board_facts sampled_from(std::uint32_t number) {
  board_facts facts = facts_of_board();
  facts.first_sample = number;
  return facts;
}

device_description described() {
  device_description device = described_board();
  device.loop.delay_samples = 1;
  device.encoder.max_speed = 2;
  return device;
}

struct run_of_a_loop {
  servo_summary summary;
  board_statistics statistics;
  std::vector<double> torques;
};

run_of_a_loop run(sampling when, bool old) {
  stepped_session<no_model> device(described(), numbered_from(old ? last_numbers : 0, when),
                                   sampled_from(old ? last_numbers : 0), old ? aged : board_age{},
                                   old ? last_times + 3 * period : 77 * period);
  std::string error;
  EXPECT_TRUE(device.start(error)) << error;
  spring_from_start<double> model;
  any_estimator<double> estimator({}, 0.001, test_plant::encoder_step);
  run_of_a_loop result;
  servo_options options;
  options.duration = 0.001 * periods;
  options.outputs.log = nullptr;
  options.outputs.observe = [&](const telemetry_record& record) { result.torques.push_back(record.motor_torque); };
  result.summary = servo_loop(model, device, estimator, options, simulated_clock{}).run();
  result.statistics = device.driver.statistics();
  return result;
}

// Sequence numbers both ways, counts, timestamps and the host's clock all turn over within this run; the force must be
// that of a run in which none does, to the rounding of a position 21 km from zero, and nothing may be lost, late or at
// fault.
TEST(Uptime, OfTheHostIsSeenByNobody) {
  for (const sampling when : {sampling::on_command, sampling::free_running}) {
    const run_of_a_loop young = run(when, false), old = run(when, true);
    EXPECT_EQ(old.summary.faults.total(), 0U) << name_of(old.summary.last_fault.kind);
    EXPECT_EQ(old.summary.held, 0U);
    EXPECT_EQ(old.summary.motor_clipped + old.summary.brake_clipped, 0U);
    EXPECT_TRUE(old.summary.safe_confirmed);
    EXPECT_EQ(old.statistics.samples.lost + old.statistics.samples.late + old.statistics.delayed, 0U);
    ASSERT_EQ(old.torques.size(), young.torques.size());
    double largest = 0;
    for (std::size_t k = 0; k < old.torques.size(); ++k) {
      // Two positions of 21475 m, each rounded to 53 bits, make a force wrong by 1000 N/m · 2 · 2⁻³⁹ m at most.
      ASSERT_NEAR(old.torques[k], young.torques[k], 1000 * 4e-12) << k;
      largest = std::max(largest, std::abs(old.torques[k]));
    }
    EXPECT_GT(largest, 1) << "the handle moves";
    EXPECT_NEAR(old.summary.energy, young.summary.energy, 1e-6);
  }
}

std::vector<sample_message> samples_of(bool old) {
  stepped_session<spring_from_start<float>> device(
      described(), numbered_from(old ? last_numbers : 0, sampling::free_running, controller::own_model),
      sampled_from(old ? last_numbers : 0), old ? aged : board_age{}, old ? last_times + 3 * period : 77 * period);
  std::string error;
  EXPECT_TRUE(device.start(error)) << error;
  std::vector<sample_message> samples;
  device_sample sample;
  for (std::uint32_t k = 0; k < periods; ++k) {
    device.read(sample);
    samples.push_back(device.driver.newest_sample());
    device.write({});
  }
  return samples;
}

// The board's own model, on the same wraps: the same force to the last bit, for whole counts are subtracted as such.
TEST(Uptime, OfTheFirmwareIsSeenByNobody) {
  const std::vector<sample_message> young = samples_of(false), old = samples_of(true);
  ASSERT_EQ(old.size(), young.size());
  for (std::size_t k = 0; k < old.size(); ++k) {
    ASSERT_EQ(old[k].state, board_state::running) << k;
    ASSERT_EQ(old[k].motor_torque, young[k].motor_torque) << k;
    ASSERT_EQ(old[k].brake_damping, young[k].brake_damping) << k;
  }
  EXPECT_LT(old.back().counts, 0) << "the counter has turned over";
  EXPECT_LT(old.back().command_sequence, shortly + 1) << "and so has the number of the commands";
}

// The number of stops has 16 bits: at its wrap a reset must still end the newest stop, and only that.
TEST(Uptime, OfTheStopsIsSeenByNobody) {
  const description_message facts = facts_of_board().description;
  supervisor board(facts, 5);
  const configure_message wish = {period, 4, 0, 5, sampling::on_command, controller::host};
  configured_message answer;
  for (int i = 0; i < 65'530; ++i) answer = board.configure(wish);
  EXPECT_TRUE(board.reset({answer.stops}));
  std::uint32_t number = 0;
  std::uint16_t before = answer.stops;
  for (int i = 0; i < 20; ++i) {
    board.obey(number++, {1, 5});
    for (int silent = 0; silent < 5; ++silent) board.pass_period();
    sample_message state;
    board.describe(state);
    EXPECT_EQ(state.stops, static_cast<std::uint16_t>(before + 1));
    EXPECT_FALSE(board.reset({before}));
    EXPECT_TRUE(board.reset({state.stops}));
    before = state.stops;
  }
  EXPECT_LT(before, 100);
}

}  // namespace
}  // namespace dashpot::uptime_test
