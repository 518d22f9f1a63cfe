#include <dashpot/board/board_device.hpp>

#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "faulty_wire.hpp"
#include "in_process_board.hpp"
#include "stream_pair.hpp"

namespace dashpot::board_faults_test {
namespace {

using namespace board;

std::uint64_t host_time = 0;  // [ns]
std::uint64_t now_by_hand() noexcept { return host_time; }

board_options by_hand() {
  board_options options;
  options.watchdog_periods = 50;
  options.now = now_by_hand;
  return options;
}

// Host and board with a wire between them that harms both ways.
template <class Plant = test_plant>
struct harmed_session {
  static constexpr unsigned axes = Plant::axes;
  explicit harmed_session(unsigned seed, stream_pair host_side = connected_pair(),
                          stream_pair board_side = connected_pair())
      : board(std::move(board_side.far)),
        device(std::move(host_side.near), described_board_with<Plant>(), by_hand()),
        wire(std::move(host_side.far), std::move(board_side.near), seed, basic_command_message<axes>::type,
             basic_sample_message<axes>::type) {
    host_time = 0;
    std::string error;
    EXPECT_TRUE(board.while_serving([&] { return device.start(error); }, [&] { wire.carry(); })) << error;
    wire.carry();
    device.read(sample);
  }

  // Of a board of two axes the last joint is driven.
  device_status exchange(double torque) {
    typename loop_types<axes>::actuation command;
    nth(command.motor_torque, axes - 1) = torque;
    nth(command.brake_damping, axes - 1) = 0.005;
    EXPECT_EQ(device.write(command), device_status::ok);
    wire.carry();
    board.serve();
    wire.carry();
    host_time += 1'000'000;
    const device_status status = device.read(sample);
    board.pass_period();
    return status;
  }

  float driven() { return nth(board.hardware().driven().motor_torque, axes - 1); }

  in_process_board<no_model, Plant> board;
  basic_board_device<axes> device;
  faulty_wire wire;
  typename loop_types<axes>::sample sample;
};

// Of 3,000 exchanges one in five comes to harm each way. The host must hand out as new only what the board measured,
// once and in order; the board must apply only what the host sent, in order; every mishap must be counted as what it
// is; and the session must go on.
template <class Plant>
void expect_faults_to_be_survived(float step) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    harmed_session<Plant> with(seed);
    with.exchange(0);
    with.wire.set_rate(0.2);
    std::uint32_t newest = with.sample.sequence;
    float applied = 0;
    for (int i = 1; i <= 3000; ++i) {
      if (i == 2990) with.wire.set_rate(0);
      const auto truth = with.board.hardware().read_encoder();
      if (with.exchange(static_cast<double>(step) * i) == device_status::ok) {
        ASSERT_LT(newest, with.sample.sequence);
        ASSERT_LE(with.sample.timestamp_ns, truth.timestamp);
        if (with.sample.timestamp_ns == truth.timestamp) {
          for (unsigned j = 0; j < Plant::axes; ++j) ASSERT_EQ(nth(with.sample.counts, j), nth(truth.counts, j));
        }
        newest = with.sample.sequence;
      }
      const float torque = with.driven();
      ASSERT_GE(torque, applied);
      ASSERT_NEAR(torque / step, std::round(torque / step), 0.01F) << "no multiple of what was sent";
      applied = torque;
    }
    const mishap_counts& up = with.wire.up().counts();
    const board_statistics host = with.device.statistics();
    EXPECT_EQ(host.frames.corrupted, up.damaged);
    EXPECT_EQ(host.samples.lost, up.lost + up.damaged);
    EXPECT_EQ(host.samples.repeated, up.repeated);
    EXPECT_EQ(host.samples.late, up.delayed);
    with.device.ask_statistics();
    with.exchange(30);
    const mishap_counts& down = with.wire.down().counts();
    ASSERT_TRUE(with.device.counts_of_board());
    const statistics_message& board = *with.device.counts_of_board();
    EXPECT_EQ(board.corrupted, down.damaged);
    EXPECT_EQ(board.lost, down.lost + down.damaged);
    EXPECT_EQ(board.repeated, down.repeated);
    EXPECT_EQ(board.late, down.delayed);
    EXPECT_GT(up.lost * up.repeated * up.damaged * up.delayed * down.lost * down.repeated * down.damaged * down.delayed,
              0U);
    EXPECT_EQ(with.device.board_state(), board_state::running);
  }
}

TEST(BoardFaults, AreSurvivedAndCounted) { expect_faults_to_be_survived<test_plant>(0.01F); }
TEST(BoardFaults, AreSurvivedAndCountedOnTwoAxes) { expect_faults_to_be_survived<test_arm>(0.0001F); }

// A wire dead towards the board must end with the motor off, and that only when the host asks for it.
TEST(BoardFaults, SilenceOfTheHostStopsTheMotor) {
  harmed_session<> with(1);
  with.exchange(2);
  with.wire.down().cut(true);
  for (int i = 0; i < 48; ++i) with.exchange(2);  // the exchange above ended with a period too
  EXPECT_EQ(with.board.hardware().driven().motor_torque, 2.0F);
  with.exchange(2);
  EXPECT_EQ(with.board.hardware().driven().motor_torque, 0.0F);
  with.wire.down().cut(false);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(with.exchange(2), device_status::fault);
  EXPECT_EQ(with.board.hardware().driven().motor_torque, 0.0F);
  with.device.reset();
  EXPECT_EQ(with.exchange(2), device_status::ok);
  EXPECT_EQ(with.board.hardware().driven().motor_torque, 2.0F);
}

// A wire dead towards the host must be told apart from a handle at rest.
TEST(BoardFaults, SilenceOfTheBoardIsStale) {
  harmed_session<> with(1);
  with.exchange(2);
  with.wire.up().cut(true);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(with.exchange(2), device_status::no_data);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(with.exchange(2), device_status::stale);
  with.wire.up().cut(false);
  EXPECT_EQ(with.exchange(2), device_status::ok);
  EXPECT_EQ(with.device.statistics().samples.lost, 103U);
}

}  // namespace
}  // namespace dashpot::board_faults_test
