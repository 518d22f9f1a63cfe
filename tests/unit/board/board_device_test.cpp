#include <dashpot/board/board_device.hpp>

#include <chrono>
#include <limits>

#include <gtest/gtest.h>

#include "in_process_board.hpp"
#include "stream_pair.hpp"

namespace dashpot {
namespace {

using namespace board;

// The host's clock, moved by hand.
std::uint64_t host_time = 0;  // [ns]
std::uint64_t now_by_hand() noexcept { return host_time; }

constexpr std::uint64_t period = 1'000'000;  // [ns]

board_options by_hand(sampling when = sampling::on_command) {
  board_options options;
  options.sampling = when;
  options.watchdog_periods = 5;
  options.now = now_by_hand;
  return options;
}

class session {
 public:
  explicit session(sampling when = sampling::on_command, stream_pair ends = connected_pair())
      : board(std::move(ends.far)), device(std::move(ends.near), described_board(), by_hand(when)) {
    host_time = 77 * period;
    std::string error;
    EXPECT_TRUE(board.while_serving([&] { return device.start(error); })) << error;
    EXPECT_EQ(device.read(sample), device_status::no_data);
    device.reset();  // to a board that runs already: only a sample comes of it
    board.serve();
    EXPECT_EQ(device.read(sample), device_status::ok);
  }

  // One period of a healthy loop.
  device_status exchange(const actuation& command = {}) {
    EXPECT_EQ(device.write(command), device_status::ok);
    board.serve();
    host_time += period;
    const device_status status = device.read(sample);
    board.pass_period();
    return status;
  }

  in_process_board<> board;
  board_device device;
  device_sample sample;
};

// A board that falls silent would be waited for as long as the host runs, or given up at once.
TEST(MonotonicNanoseconds, AreThoseOfTheSteadyClock) {
  const auto steady = [] {
    return std::uint64_t(
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
            .count());
  };
  const std::uint64_t before = steady(), between = monotonic_nanoseconds(), after = steady();
  EXPECT_LE(before, between);
  EXPECT_LE(between, after);
}

// Where both clocks pace, the numbers that the loop gets must be the board's.
TEST(BoardDevice, HandsOutWhatTheBoardMeasured) {
  session with;
  std::uint32_t sequence = with.sample.sequence;
  for (int i = 0; i < 600; ++i) {
    const encoder_reading truth = with.board.hardware().read_encoder();
    ASSERT_EQ(with.exchange(), device_status::ok);
    ASSERT_EQ(with.sample.counts, truth.counts);
    ASSERT_EQ(with.sample.position, static_cast<double>(truth.counts) * test_plant::encoder_step);
    ASSERT_EQ(with.sample.timestamp_ns, truth.timestamp);
    ASSERT_EQ(with.sample.edge_time_ns, truth.edge_time);
    ASSERT_EQ(with.sample.sequence, ++sequence);
  }
  EXPECT_GT(with.sample.counts, 100);
  EXPECT_NE(with.sample.edge_time_ns, 0U);
}

// The command must reach motor and brake unchanged in sign and unit, in the same period.
TEST(BoardDevice, DeliversCommands) {
  session with;
  with.exchange({-3.25, 7.5});
  EXPECT_EQ(with.board.hardware().driven().motor_torque, -3.25F);
  EXPECT_EQ(with.board.hardware().driven().brake_damping, 7.5F);
  EXPECT_EQ(with.device.newest_sample().motor_torque, -3.25F);
  EXPECT_EQ(with.device.newest_sample().command_sequence, 0U);
}

// A NaN or infinite command must stop the motor at once, and the loop must hear of it.
TEST(BoardDevice, SendsTheSafeCommandInPlaceOfABadOne) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    session with;
    with.exchange({2, 3});
    EXPECT_EQ(with.device.write({bad, 3}), device_status::fault);
    with.board.serve();
    EXPECT_EQ(with.board.hardware().driven().motor_torque, 0.0F);
    EXPECT_EQ(with.board.hardware().driven().brake_damping, 4.0F);
  }
}

// The servo loop tells a pause from an outage by these two.
TEST(BoardDevice, CallsAPauseNoDataAndAnOutageStale) {
  session with;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(with.device.read(with.sample), device_status::no_data);
  EXPECT_EQ(with.device.read(with.sample), device_status::stale);
  EXPECT_EQ(with.exchange(), device_status::ok);
  EXPECT_EQ(with.device.read(with.sample), device_status::no_data);
}

// Only the newest of several waiting samples is worth computing with.
TEST(BoardDevice, HandsOutTheNewest) {
  session with(sampling::free_running);
  for (int i = 0; i < 20; ++i) with.board.pass_period();
  const std::uint32_t before = with.sample.sequence;
  EXPECT_EQ(with.device.read(with.sample), device_status::ok);
  EXPECT_EQ(with.sample.sequence, before + 20);
  EXPECT_EQ(with.sample.counts, with.board.hardware().read_encoder().counts);
  EXPECT_EQ(with.device.read(with.sample), device_status::no_data);
}

// A stream that has fallen behind delivers one sample a period like a healthy one: only its age gives it away.
TEST(BoardDevice, CallsADelayedStreamStale) {
  session with(sampling::free_running);
  const auto pass = [&](std::uint64_t host_periods) {
    with.board.pass_period();
    host_time += host_periods * period;
    return with.device.read(with.sample);
  };
  for (int i = 0; i < 10; ++i) ASSERT_EQ(pass(1), device_status::ok);
  EXPECT_EQ(pass(5), device_status::ok) << "four periods late, as many as missed_deadlines_allowed + 1";
  EXPECT_EQ(pass(2), device_status::stale);
  EXPECT_EQ(pass(1), device_status::stale);
  EXPECT_EQ(with.sample.counts, with.board.hardware().read_encoder().counts) << "the sample is handed out all the same";
  EXPECT_EQ(with.device.statistics().delayed, 2U);
}

// Damage must be told from silence: it points at the cable.
TEST(BoardDevice, ReportsDamage) {
  stream_pair ends = connected_pair();
  transport intruder(::dup(ends.far.descriptor()), transport::kind::stream_socket);
  session with(sampling::on_command, std::move(ends));
  encoded_frame damaged = encode(with.device.newest_sample(), 99);
  damaged.bytes[20] ^= 1;
  intruder.write(damaged.bytes, damaged.size);
  const std::int64_t before = with.sample.counts;
  EXPECT_EQ(with.device.read(with.sample), device_status::corrupted);
  EXPECT_EQ(with.sample.counts, before);
  EXPECT_EQ(with.device.statistics().frames.corrupted, 1U);
  EXPECT_EQ(with.exchange(), device_status::ok);
}

// A sample that comes again must not be computed with as if the handle had stopped.
TEST(BoardDevice, CallsARepeatedSampleStale) {
  stream_pair ends = connected_pair();
  transport intruder(::dup(ends.far.descriptor()), transport::kind::stream_socket);
  session with(sampling::on_command, std::move(ends));
  with.exchange();
  const encoded_frame again = encode(with.device.newest_sample(), with.sample.sequence);
  intruder.write(again.bytes, again.size);
  EXPECT_EQ(with.device.read(with.sample), device_status::stale);
  EXPECT_EQ(with.device.statistics().samples.repeated, 1U);
}

// The counter of 32 bits turns over; the position must go on.
TEST(BoardDevice, UnwrapsTheCounter) {
  stream_pair ends = connected_pair();
  transport intruder(::dup(ends.far.descriptor()), transport::kind::stream_socket);
  session with(sampling::on_command, std::move(ends));
  sample_message sample = with.device.newest_sample();
  std::uint32_t sequence = with.sample.sequence;
  std::int64_t expected = sample.counts;
  for (const std::int32_t move : {2'000'000'000, 2'000'000'000, 1'000'000'000, -2'000'000'000}) {
    expected += move;
    sample.counts =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(sample.counts) + static_cast<std::uint32_t>(move));
    const encoded_frame frame = encode(sample, ++sequence);
    intruder.write(frame.bytes, frame.size);
    with.device.read(with.sample);
    EXPECT_EQ(with.sample.counts, expected);
  }
}

// Watchdog, report and recovery from end to end: the loop must see the stop and end it only by asking.
TEST(BoardDevice, ReportsTheWatchdogAndRecoversOnReset) {
  session with;
  with.exchange({2, 3});
  for (int i = 0; i < 5; ++i) with.board.pass_period();
  EXPECT_EQ(with.board.hardware().driven().motor_torque, 0.0F);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(with.exchange({2, 3}), device_status::fault);
  EXPECT_EQ(with.device.board_state(), board_state::safe);
  EXPECT_EQ(with.device.stop_cause(), stop_cause::host_silent);
  EXPECT_EQ(with.board.hardware().driven().motor_torque, 0.0F);
  EXPECT_EQ(with.device.reset(), device_status::ok);
  EXPECT_EQ(with.exchange({2, 3}), device_status::ok);
  EXPECT_EQ(with.board.hardware().driven().motor_torque, 2.0F);
}

// A pulled cable must be an answer of its own, for reading and writing, and for good.
TEST(BoardDevice, ReportsAClosedStream) {
  stream_pair ends = connected_pair();
  board_device device(std::move(ends.near), described_board());
  {
    in_process_board<> board(std::move(ends.far));
    std::string error;
    ASSERT_TRUE(board.while_serving([&] { return device.start(error); })) << error;
    device.write({});
    board.serve();
  }
  device_sample sample;
  EXPECT_EQ(device.read(sample), device_status::ok) << "what came before the end counts";
  EXPECT_EQ(device.read(sample), device_status::disconnected);
  EXPECT_EQ(device.write({}), device_status::disconnected);
  EXPECT_EQ(device.reset(), device_status::disconnected);
}

// Before start() nothing must reach the board.
TEST(BoardDevice, IsDisconnectedBeforeStart) {
  stream_pair ends = connected_pair();
  board_device device(std::move(ends.near), described_board());
  device_sample sample;
  EXPECT_EQ(device.read(sample), device_status::disconnected);
  EXPECT_EQ(device.write({1, 1}), device_status::disconnected);
  std::uint8_t byte = 0;
  EXPECT_EQ(ends.far.read(&byte, 1), 0U);
}

// A board that does not listen must neither block the loop nor get a backlog of old commands later.
TEST(BoardDevice, DropsCommandsThatAFullStreamDoesNotTake) {
  session with;
  unsigned left = 0;
  while (with.device.write({1, 1}) == device_status::ok) ++left;
  EXPECT_EQ(with.device.write({2, 2}), device_status::stale);
  EXPECT_EQ(with.device.statistics().commands_dropped, 2U);
  EXPECT_EQ(with.device.statistics().commands_sent, left);
  with.board.serve();
  EXPECT_EQ(with.device.write({3, 3}), device_status::ok);
  with.board.serve();
  EXPECT_EQ(with.board.hardware().driven().motor_torque, 3.0F);
  EXPECT_EQ(with.board.state().command_statistics().lost, 0U) << "what never left is not lost";
}

// The whole driver over a terminal: a byte that the line discipline ate would show here.
TEST(BoardDevice, WorksOverAPseudoTerminal) {
  std::string error;
  auto near = open_transport("pty:", error);
  ASSERT_TRUE(near) << error;
  auto far = open_transport("serial:" + near->far_end(), error);
  ASSERT_TRUE(far) << error;
  session with(sampling::on_command, {std::move(*near), std::move(*far)});
  for (int i = 0; i < 1000; ++i) {
    const double torque = 0.001 * i;
    ASSERT_EQ(with.device.write({torque, 5}), device_status::ok);
    with.board.hardware().stream().wait_readable(1000);
    with.board.serve();
    with.device.wait_for_sample(1000);
    ASSERT_EQ(with.device.read(with.sample), device_status::ok);
    ASSERT_EQ(with.device.newest_sample().motor_torque, static_cast<float>(torque));
    with.board.pass_period();
  }
  EXPECT_EQ(with.device.statistics().frames.discarded_bytes, 0U);
}

// The counts of the board itself are half of what a user needs to find a bad cable.
TEST(BoardDevice, FetchesTheCountsOfTheBoard) {
  session with;
  for (int i = 0; i < 10; ++i) with.exchange();
  EXPECT_FALSE(with.device.counts_of_board());
  EXPECT_EQ(with.device.ask_statistics(), device_status::ok);
  with.exchange();
  ASSERT_TRUE(with.device.counts_of_board());
  EXPECT_EQ(with.device.counts_of_board()->received, 4U + 10U + 1U)
      << "hello, configure, two resets, commands, the question";
}

// By the time that a loop runs, the sample that answered the reset is some milliseconds old: a handle that moves would
// seem to jump from there.
TEST(BoardDevice, HandsOutNothingFromBeforeTheEndOfItsStart) {
  for (const sampling when : {sampling::on_command, sampling::free_running}) {
    stream_pair ends = connected_pair();
    in_process_board<> board(std::move(ends.far));
    board_device device(std::move(ends.near), described_board(), by_hand(when));
    std::string error;
    ASSERT_TRUE(board.while_serving([&] { return device.start(error); })) << error;
    device_sample sample;
    EXPECT_EQ(device.read(sample), device_status::no_data);
    for (int i = 0; i < 5; ++i) board.pass_period();
    device.write({});
    board.serve();
    board.pass_period();
    ASSERT_EQ(device.read(sample), device_status::ok);
    EXPECT_GE(sample.timestamp_ns, board.hardware().time() - period);
  }
}

// A board that has run freely since its start has filled the stream with what nobody wants: read first as if it were
// new, that would be a handle in the past.
TEST(BoardDevice, DropsWhatGatheredBetweenStartAndTheFirstRead) {
  stream_pair ends = connected_pair();
  in_process_board<> board(std::move(ends.far));
  board_device device(std::move(ends.near), described_board(), by_hand(sampling::free_running));
  std::string error;
  ASSERT_TRUE(board.while_serving([&] { return device.start(error); })) << error;
  for (int i = 0; i < 1500; ++i) board.pass_period();  // more than the stream holds
  device_sample sample;
  EXPECT_EQ(device.read(sample), device_status::no_data);
  board.pass_period();
  ASSERT_EQ(device.read(sample), device_status::ok);
  EXPECT_EQ(sample.timestamp_ns, board.hardware().time());
}

// The loop confirms, counts and reckons with what the board says that it applies: of which command must be right.
TEST(BoardDevice, TellsWhatTheBoardApplies) {
  session with;
  EXPECT_FALSE(with.sample.report.told) << "no command yet";
  with.exchange({1, 2});
  with.exchange({80, 40});
  ASSERT_TRUE(with.sample.report.told);
  EXPECT_EQ(with.sample.report.commands_ago, 0U);
  EXPECT_EQ(with.sample.report.applied.motor_torque, 50);
  EXPECT_EQ(with.sample.report.applied.brake_damping, 30);
  with.device.write({3, 3});
  with.board.serve();
  with.device.write({4, 4});
  with.device.write({5, 5});
  ASSERT_EQ(with.device.read(with.sample), device_status::ok);
  EXPECT_EQ(with.sample.report.commands_ago, 2U);
  EXPECT_EQ(with.sample.report.applied.motor_torque, 3);
}

// "The device answers 'fault'" sends nobody to the right place.
TEST(BoardDevice, SaysWhyTheBoardStopped) {
  session with;
  with.exchange({2, 3});
  for (int i = 0; i < 5; ++i) with.board.pass_period();
  EXPECT_EQ(with.exchange({2, 3}), device_status::fault);
  EXPECT_STREQ(with.device.cause(), "the board's watchdog: no command came for too long");
}

// A damaged frame whose check sum fits has a number like any other: every later sample would seem old.
TEST(BoardDevice, SurvivesOneWildSequenceNumber) {
  stream_pair ends = connected_pair();
  transport intruder(::dup(ends.far.descriptor()), transport::kind::stream_socket);
  session with(sampling::on_command, std::move(ends));
  with.exchange();
  const encoded_frame wild = encode(with.device.newest_sample(), with.sample.sequence + 0x4000'0000U);
  intruder.write(wild.bytes, wild.size);
  EXPECT_EQ(with.device.read(with.sample), device_status::stale);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(with.exchange(), device_status::ok);
}

// A board that was switched off and on counts from 0 again: the loop must learn that it stopped, not that it is silent.
TEST(BoardDevice, SeesThatABoardBeganAnew) {
  stream_pair ends = connected_pair();
  transport again(::dup(ends.far.descriptor()), transport::kind::stream_socket);
  auto before = std::make_unique<session>(sampling::on_command, std::move(ends));
  for (int i = 0; i < 2000; ++i) before->exchange();
  in_process_board<> rebooted(std::move(again));
  device_status status = device_status::ok;
  for (int i = 0; i < 5; ++i) {
    before->device.write({2, 3});
    rebooted.serve();
    host_time += period;
    status = before->device.read(before->sample);
  }
  EXPECT_EQ(status, device_status::fault);
  EXPECT_STREQ(before->device.cause(), "the board is idle: it was switched on or configured since the start");
  EXPECT_EQ(rebooted.hardware().driven().motor_torque, 0.0F);
}

}  // namespace
}  // namespace dashpot
