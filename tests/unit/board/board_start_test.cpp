#include <dashpot/board/board_device.hpp>

#include <chrono>
#include <deque>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

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
TEST(BoardStart, ConfiguresAndRuns) {
  stream_pair ends = connected_pair();
  in_process_board<> board(std::move(ends.far));
  board_device device(std::move(ends.near), described_board());
  std::string error;
  ASSERT_TRUE(board.while_serving([&] { return device.start(error); })) << error;
  EXPECT_TRUE(board.state().running());
  EXPECT_EQ(board.state().configuration().period, 1'000'000U);
  EXPECT_EQ(board.state().configuration().safe_damping, 4.0F);
  EXPECT_EQ(board.state().configuration().watchdog_periods, 8) << "three missed, three lost, and two";
  EXPECT_STREQ(device.description_of_board().name, "in process");
  device_sample sample;
  device.write({});
  board.serve();
  EXPECT_EQ(device.read(sample), device_status::ok);
  EXPECT_EQ(sample.timestamp_ns, board.hardware().time());
}

// A device file of another device would make every force and every certificate wrong by a factor.
TEST(BoardStart, RefusesAnotherDevice) {
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
TEST(BoardStart, AcceptsAStrongerBoard) {
  EXPECT_EQ(with_description([](auto& d) { d.motor.max_torque = 1; }), "started");
  EXPECT_EQ(with_description([](auto& d) { d.brake.max_damping = 10; }), "started");
  EXPECT_EQ(with_description([](auto& d) { d.encoder.step = 0.01 / 1000 * (1 + 1e-15); }), "started");
}

// The user must learn why the board does not start, not that it does not.
TEST(BoardStart, PassesOnWhyTheBoardRefuses) {
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
TEST(BoardStart, ExplainsSilence) {
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
TEST(BoardStart, RepeatsWhatIsNotAnswered) {
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

// What the first read after a start says, of commands that are written and served until it is not stale: where a slow
// machine asked a question twice, the second answer makes the first sample stale.
device_status first_status(board_device& device, in_process_board<>& board, const actuation& command) {
  device_sample sample;
  device_status status = device_status::stale;
  for (int i = 0; i < 3 && status == device_status::stale; ++i) {
    device.write(command);
    board.serve();
    status = device.read(sample);
  }
  return status;
}

// A second start on the same stream is how a session recovers after the board was switched off and on.
TEST(BoardStart, StartsAgainWithABoardThatForgotEverything) {
  stream_pair ends = connected_pair();
  auto before =
      std::make_unique<in_process_board<>>(transport(::dup(ends.far.descriptor()), transport::kind::stream_socket));
  board_device device(std::move(ends.near), described_board());
  std::string error;
  ASSERT_TRUE(before->while_serving([&] { return device.start(error); })) << error;
  ASSERT_EQ(first_status(device, *before, {}), device_status::ok);
  device_sample sample;
  for (int i = 0; i < 100; ++i) {
    device.write({});
    before->serve();
    ASSERT_EQ(device.read(sample), device_status::ok);
  }
  before.reset();
  in_process_board<> after(std::move(ends.far));
  ASSERT_TRUE(after.while_serving([&] { return device.start(error); })) << error;
  ASSERT_EQ(first_status(device, after, {1, 2}), device_status::ok);
  EXPECT_EQ(after.hardware().driven().motor_torque, 1.0F);
}

// 0 in a device file means any effort, 0 on a board means none: a weaker board would clip what was certified unlimited.
TEST(BoardStart, DoesNotTakeALimitForNone) {
  const auto unlimited = [](auto& d) { d.motor.max_torque = 0; };
  EXPECT_EQ(with_description(unlimited),
            "largest motor effort of the board is 50 N, the device file states no 'max_torque', which means any");
  device_description described = described_board();
  unlimited(described);
  board_facts facts = facts_of_board();
  facts.description.max_torque = 0;
  EXPECT_EQ(outcome(described, facts),
            "largest motor effort of the board is 0 N, the device file states no 'max_torque', which means any");
  facts.description.max_torque = std::numeric_limits<float>::infinity();
  EXPECT_EQ(outcome(described, facts), "started");
}

// Every comparison with NaN is false, so that a board which states it would be as strong as anybody asks.
TEST(BoardStart, RefusesABoardThatStatesNoNumbers) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  board_facts facts = facts_of_board();
  facts.description.max_torque = nan;
  EXPECT_EQ(outcome(described_board(), facts), "the board's largest motor effort is no number");
  facts = facts_of_board();
  facts.description.max_damping = nan;
  EXPECT_EQ(outcome(described_board(), facts), "the board's largest damping is no number");
  facts = facts_of_board();
  facts.description.encoder_step = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(outcome(described_board(), facts), "encoder step of the board is nan m, the device file says 1e-05 m");
}

// The watchdog must outlast what the loop itself tolerates, and not by more than the loop needs.
TEST(BoardStart, DerivesTheWatchdogFromWhatMayBeMissed) {
  for (const auto& [allowed, expected] : {std::pair(0U, 2), {20U, 42}, {1'000'000U, 65535}}) {
    stream_pair ends = connected_pair();
    in_process_board<> board(std::move(ends.far));
    device_description described = described_board();
    described.loop.missed_deadlines_allowed = allowed;
    board_device device(std::move(ends.near), described);
    std::string error;
    ASSERT_TRUE(board.while_serving([&] { return device.start(error); })) << error;
    EXPECT_EQ(board.state().configuration().watchdog_periods, expected);
  }
}

// Everything that passes this way arrives `delay` later.
class slow_way {
 public:
  explicit slow_way(std::chrono::milliseconds delay) : delay_(delay) {}

  void carry(transport& from, transport& to) {
    const auto now = std::chrono::steady_clock::now();
    std::uint8_t bytes[4096];
    while (const std::size_t count = from.read(bytes, sizeof bytes))
      under_way_.push_back({now + delay_, {bytes, bytes + count}});
    for (; !under_way_.empty() && under_way_.front().first <= now; under_way_.pop_front())
      to.write(under_way_.front().second.data(), under_way_.front().second.size());
  }

 private:
  std::chrono::milliseconds delay_;
  std::deque<std::pair<std::chrono::steady_clock::time_point, std::vector<std::uint8_t>>> under_way_;
};

// A link of 30 ms each way answers after the question has been repeated, and a board that needs 60 ms to configure
// itself does so twice then: the number of stops that the reset must quote grows meanwhile.
TEST(BoardStart, WaitsForSlowBoardsAndSlowLinks) {
  using std::chrono::milliseconds;
  for (const auto& [link, work] : {std::pair(milliseconds(30), milliseconds(0)),
                                   {milliseconds(0), milliseconds(60)},
                                   {milliseconds(30), milliseconds(60)}}) {
    stream_pair host_side = connected_pair(), board_side = connected_pair();
    in_process_board<> board(std::move(board_side.far));
    board_options options;
    options.start_time = 30'000;  // of a busy machine
    board_device device(std::move(host_side.near), described_board(), options);
    slow_way down(link), up(link);
    // The work is done in the firmware: what comes meanwhile waits.
    std::uint16_t stops = 0;
    const auto also = [&, work = work] {
      down.carry(host_side.far, board_side.near);
      sample_message state;
      board.state().describe(state);
      if (state.stops != stops) std::this_thread::sleep_for(work);
      stops = state.stops;
      up.carry(board_side.near, host_side.far);
    };
    std::string error;
    ASSERT_TRUE(board.while_serving([&] { return device.start(error); }, also)) << error;
    EXPECT_TRUE(board.state().running());
    // Nothing that start() sent is still under way to stop it again.
    const auto end = std::chrono::steady_clock::now() + 2 * link + 2 * work + milliseconds(20);
    while (std::chrono::steady_clock::now() < end) also(), board.serve();
    EXPECT_TRUE(board.state().running()) << link.count() << " ms away, " << work.count() << " ms of work";
  }
}

}  // namespace
}  // namespace dashpot
