#include <dashpot/board/board_device.hpp>

#include <gtest/gtest.h>

#include "in_process_board.hpp"
#include "stream_pair.hpp"

namespace dashpot {
namespace {

using namespace board;

// What start() says to a board with these facts; "started" where it succeeds.
template <class Model = generated::stand_in_model>
std::string outcome(const device_description& described, const board_facts& facts, board_options options = {}) {
  stream_pair ends = connected_pair();
  in_process_board<Model> board(std::move(ends.far), facts);
  board_device device(std::move(ends.near), described, options);
  std::string error;
  const bool started = board.while_serving([&] { return device.start(error); });
  return started ? "started" : error;
}

template <class Change>
std::string with_description(Change change) {
  device_description described = described_board();
  change(described);
  return outcome(described, facts_of_board());
}

// After start() the board must run with what the device file states, and hand out its first sample.
TEST(BoardStart, configures_and_runs) {
  stream_pair ends = connected_pair();
  in_process_board<> board(std::move(ends.far));
  board_device device(std::move(ends.near), described_board());
  std::string error;
  ASSERT_TRUE(board.while_serving([&] { return device.start(error); })) << error;
  EXPECT_TRUE(board.state().running());
  EXPECT_EQ(board.state().configuration().period, 1'000'000U);
  EXPECT_EQ(board.state().configuration().safe_damping, 4.0F);
  EXPECT_EQ(board.state().configuration().watchdog_periods, board_options().watchdog_periods);
  EXPECT_STREQ(device.description_of_board().name, "in process");
  device_sample sample;
  EXPECT_EQ(device.read(sample), device_status::ok);
  EXPECT_EQ(sample.timestamp_ns, board.hardware().time());
}

// A device file of another device would make every force and every certificate wrong by a factor.
TEST(BoardStart, refuses_another_device) {
  EXPECT_EQ(with_description([](auto&) {}), "started");
  EXPECT_EQ(with_description([](auto& d) { d.encoder.step = 2e-5; }),
            "encoder step of the board is 1e-05 m, the device file says 2e-05 m");
  EXPECT_EQ(with_description([](auto& d) { d.motor.max_torque = 51; }),
            "largest motor effort of the board is 50 N, the device file says 51 N");
  EXPECT_EQ(with_description([](auto& d) { d.brake.max_damping = 31; }),
            "largest damping of the board is 30 N s/m, the device file says 31 N s/m");
  EXPECT_EQ(with_description([](auto& d) { d.motion = motion::rotation; }),
            "one of board and device file turns, the other slides");
}

// A board that can do more than the file asks for is the described one; so is one whose step was multiplied in another
// order.
TEST(BoardStart, accepts_a_stronger_board) {
  EXPECT_EQ(with_description([](auto& d) { d.motor.max_torque = 1; }), "started");
  EXPECT_EQ(with_description([](auto& d) { d.brake.max_damping = 10; }), "started");
  EXPECT_EQ(with_description([](auto& d) { d.encoder.step = 0.01 / 1000 * (1 + 1e-15); }), "started");
}

// The user must learn why the board does not start, not that it does not.
TEST(BoardStart, passes_on_why_the_board_refuses) {
  device_description fast = described_board();
  fast.loop.sample_period = 5e-5;
  EXPECT_EQ(outcome(fast, facts_of_board()),
            "the board refuses the configuration: its shortest period is longer than the loop's");
  board_options careless;
  careless.watchdog_periods = 0;
  EXPECT_EQ(
      outcome(described_board(), facts_of_board(), careless),
      "the board refuses the configuration: a board that the host controls needs a watchdog of one period or more");
  board_options alone;
  alone.controller = controller::own_model;
  EXPECT_EQ(outcome(described_board(), facts_of_board(), alone),
            "the board refuses the configuration: it does not know this sampling with this controller");
  alone.sampling = sampling::free_running;
  EXPECT_EQ(outcome<no_model>(described_board(), facts_of_board(), alone),
            "the board refuses the configuration: its firmware was built without a model");
  EXPECT_EQ(outcome(described_board(), facts_of_board(), alone), "started");
}

// What an unlucky start says: with nobody there, at the wrong rate, with a newer board, with the cable pulled.
TEST(BoardStart, explains_silence) {
  board_options brief;
  brief.start_time = 60;
  const auto outcome_of = [&](auto&& act) {
    stream_pair ends = connected_pair();
    board_device device(std::move(ends.near), described_board(), brief);
    act(ends.far);
    std::string error;
    EXPECT_FALSE(device.start(error));
    return error;
  };
  const auto put = [](transport& into, const std::vector<std::uint8_t>& bytes) {
    into.write(bytes.data(), bytes.size());
  };
  EXPECT_EQ(outcome_of([](transport&) {}), "no answer to hello");
  EXPECT_EQ(outcome_of([&](transport& far) {
              put(far, {1, 2, 3, 4, 5});
            }),
            "no answer to hello: 5 bytes came, but no frame; another baud rate?");
  EXPECT_EQ(outcome_of([&](transport& far) {
              std::vector<std::uint8_t> newer = {'d', 'p', 2, 0x96, 0, 0, 0, 0, 0};
              const std::uint16_t crc = crc16(newer.data() + 2, newer.size() - 2);
              newer.push_back(static_cast<std::uint8_t>(crc & 0xFF));
              newer.push_back(static_cast<std::uint8_t>(crc >> 8));
              put(far, newer);
            }),
            "no answer to hello: the board speaks protocol version 2, this host 1");
  EXPECT_EQ(outcome_of([](transport& far) { const transport gone = std::move(far); }),
            "no answer to hello: the stream was closed");
}

// The first frames after plugging in are often damaged: questions must be repeated, not asked once.
TEST(BoardStart, repeats_what_is_not_answered) {
  stream_pair ends = connected_pair();
  in_process_board<> board(std::move(ends.far));
  board_device device(std::move(ends.near), described_board());
  int turns_deaf = 200;
  const auto sometimes_deaf = [&] {
    std::uint8_t swallowed[256];
    if (turns_deaf > 0 && board.hardware().stream().read(swallowed, sizeof swallowed) != 0) turns_deaf = 0;
  };
  std::string error;
  EXPECT_TRUE(board.while_serving([&] { return device.start(error); }, sometimes_deaf)) << error;
}

// A second start on the same stream is how a session recovers after the board was switched off and on.
TEST(BoardStart, starts_again_with_a_board_that_forgot_everything) {
  stream_pair ends = connected_pair();
  auto before =
      std::make_unique<in_process_board<>>(transport(::dup(ends.far.descriptor()), transport::kind::stream_socket));
  board_device device(std::move(ends.near), described_board());
  std::string error;
  ASSERT_TRUE(before->while_serving([&] { return device.start(error); })) << error;
  device_sample sample;
  for (int i = 0; i < 100; ++i) {
    device.write({});
    before->serve();
    ASSERT_EQ(device.read(sample), device_status::ok);
  }
  before.reset();
  in_process_board<> after(std::move(ends.far));
  ASSERT_TRUE(after.while_serving([&] { return device.start(error); })) << error;
  ASSERT_EQ(device.read(sample), device_status::ok);
  device.write({1, 2});
  after.serve();
  ASSERT_EQ(device.read(sample), device_status::ok);
  EXPECT_EQ(after.hardware().driven().motor_torque, 1.0F);
}

}  // namespace
}  // namespace dashpot
