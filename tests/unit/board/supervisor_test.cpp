#include <dashpot/board/supervisor.hpp>

#include <limits>

#include <gtest/gtest.h>

namespace dashpot::board {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

description_message facts(std::uint32_t model_period = 0) {
  return {1e-5, 2.0F, 30.0F, 100'000, model_period, motion::translation, ""};
}

configure_message wish(controller who = controller::host) {
  return {1'000'000, 4.0F, 0.5F, 5, who == controller::host ? sampling::on_command : sampling::free_running, who};
}

sample_message seen(const supervisor& board) {
  sample_message sample;
  board.describe(sample);
  return sample;
}

supervisor running(controller who = controller::host) {
  supervisor board(facts(1'000'000), 5.0F);
  board.reset({board.configure(wish(who)).stops});
  return board;
}

void expect_applied(const supervisor& board, float torque, float damping) {
  EXPECT_EQ(board.applied().motor_torque, torque);
  EXPECT_EQ(board.applied().brake_damping, damping);
}

void expect_stopped(const supervisor& board, stop_cause cause) {
  EXPECT_EQ(seen(board).state, board_state::safe);
  EXPECT_EQ(seen(board).cause, cause);
  expect_applied(board, 0, 4.0F);
}

// A board that makes torque at power-on, or before it is configured, would hit whoever switches it on.
TEST(Supervisor, MakesNothingUntilConfiguredAndReset) {
  supervisor board(facts(), 5.0F);
  board.obey(0, {1.0F, 20.0F});
  expect_applied(board, 0, 5.0F);
  EXPECT_FALSE(board.reset({0}));
  board.obey(1, {1.0F, 20.0F});
  expect_applied(board, 0, 5.0F);
  const configured_message answer = board.configure(wish());
  EXPECT_EQ(answer.verdict, verdict::accepted);
  board.obey(2, {1.0F, 20.0F});
  expect_applied(board, 0, 4.0F);
  EXPECT_TRUE(board.reset({answer.stops}));
  expect_applied(board, 0, 4.0F);
  board.obey(3, {1.0F, 20.0F});
  expect_applied(board, 1.0F, 20.0F);
}

// The promise of the watchdog: after the stated number of silent periods, not one more, the motor makes nothing.
TEST(Supervisor, StopsAfterTheStatedSilence) {
  supervisor board = running();
  board.obey(0, {1.0F, 20.0F});
  for (int period = 0; period < 4; ++period) board.pass_period();
  expect_applied(board, 1.0F, 20.0F);
  board.pass_period();
  expect_stopped(board, stop_cause::host_silent);
}

// A host that talks again, or repeats itself, must not bring the motor back by that alone.
TEST(Supervisor, LeavesSafeOnlyOnReset) {
  supervisor board = running();
  board.obey(0, {1.0F, 20.0F});
  for (int period = 0; period < 5; ++period) board.pass_period();
  for (std::uint32_t i = 1; i < 20; ++i) board.obey(i, {1.0F, 20.0F});
  expect_stopped(board, stop_cause::host_silent);
  EXPECT_TRUE(board.reset({seen(board).stops}));
  EXPECT_EQ(seen(board).state, board_state::running);
  expect_applied(board, 0, 4.0F);
  board.obey(20, {-1.0F, 10.0F});
  expect_applied(board, -1.0F, 10.0F);
}

// A reset that was repeated or delayed on the way would end a later stop that nobody has looked at.
TEST(Supervisor, IgnoresAResetForAnEarlierStop) {
  supervisor board = running();
  const std::uint16_t earlier = seen(board).stops;
  board.obey(0, {nan, 0});
  EXPECT_FALSE(board.reset({earlier}));
  expect_stopped(board, stop_cause::bad_command);
}

// Repeated and overtaken commands must neither move the motor nor count as a sign of life.
TEST(Supervisor, ObeysOnlyNewerCommands) {
  supervisor board = running();
  board.obey(10, {1.0F, 20.0F});
  EXPECT_FALSE(board.obey(10, {0.5F, 1.0F}));
  EXPECT_FALSE(board.obey(9, {0.5F, 1.0F}));
  expect_applied(board, 1.0F, 20.0F);
  for (int period = 0; period < 5; ++period) {
    board.obey(10, {0.5F, 1.0F});
    board.pass_period();
  }
  expect_stopped(board, stop_cause::host_silent);
}

// Silence between reset and the first command is the host starting up; the motor makes nothing then anyway.
TEST(Supervisor, WaitsForTheFirstCommandOfTheHost) {
  supervisor board = running();
  for (int period = 0; period < 1000; ++period) board.pass_period();
  EXPECT_TRUE(board.running());
}

// A command beyond the limits is limited; one that is NaN or infinite is a defect of the host and stops the board.
TEST(Supervisor, LimitsCommandsAndStopsAtBadOnes) {
  supervisor board = running();
  board.obey(0, {5.0F, 100.0F});
  expect_applied(board, 2.0F, 30.0F);
  board.obey(1, {-5.0F, -1.0F});
  expect_applied(board, -2.0F, 0.0F);
  std::uint32_t sequence = 2;
  for (const command_message bad : {command_message{nan, 1}, {infinite, 1}, {0, nan}, {0, -infinite}}) {
    supervisor fresh = running();
    fresh.obey(sequence, {1, 1});
    fresh.obey(++sequence, bad);
    expect_stopped(fresh, stop_cause::bad_command);
  }
}

// With its own model the board must take the host's commands as signs of life only, and need them if so configured.
TEST(Supervisor, RunsItsOwnModelUnderTheWatchdog) {
  supervisor board = running(controller::own_model);
  board.obey_model({1.5F, 11.0F}, 0.1F);
  expect_applied(board, 1.5F, 11.0F);
  board.obey(0, {-2.0F, 1.0F});
  expect_applied(board, 1.5F, 11.0F);
  for (int period = 0; period < 5; ++period) board.pass_period();
  expect_stopped(board, stop_cause::host_silent);
  board.obey_model({1.5F, 11.0F}, 0.1F);
  expect_stopped(board, stop_cause::host_silent);
}

// The motor of an own model is on from the reset: a host that dies right after it must be noticed too.
TEST(Supervisor, WatchesItsOwnModelFromTheResetOn) {
  supervisor board = running(controller::own_model);
  board.obey_model({1.5F, 11.0F}, 0.1F);
  for (int period = 0; period < 5; ++period) board.pass_period();
  expect_stopped(board, stop_cause::host_silent);
}

// Alone on its own model nobody else watches over the board.
TEST(Supervisor, StopsItsOwnModelWhenItFailsOrRunsAway) {
  for (const outputs bad : {outputs{nan, 1}, {1, infinite}}) {
    supervisor board = running(controller::own_model);
    board.obey_model(bad, 0);
    expect_stopped(board, stop_cause::bad_model_command);
  }
  for (const float speed : {0.51F, -0.51F, nan}) {
    supervisor board = running(controller::own_model);
    board.obey_model({1, 1}, speed);
    expect_stopped(board, stop_cause::overspeed);
  }
}

// A board alone on its model may run without a host for ever; one that the host controls may not.
TEST(Supervisor, NeedsAWatchdogWhereTheHostControls) {
  supervisor board(facts(1'000'000), 5.0F);
  configure_message alone = wish(controller::own_model);
  alone.watchdog_periods = 0;
  board.reset({board.configure(alone).stops});
  board.obey_model({1, 1}, 0);
  for (int period = 0; period < 100'000; ++period) board.pass_period();
  EXPECT_TRUE(board.running());
  configure_message careless = wish();
  careless.watchdog_periods = 0;
  EXPECT_EQ(board.configure(careless).verdict, verdict::watchdog_needed);
}

// Each refusal that the README names, and that a refused board stays idle whatever the host sends.
TEST(Supervisor, RefusesWhatItCannotDo) {
  const auto verdict_on = [](auto change, std::uint32_t model_period = 1'000'000) {
    configure_message changed = wish(controller::own_model);
    change(changed);
    supervisor board(facts(model_period), 5.0F);
    const configured_message answer = board.configure(changed);
    EXPECT_FALSE(board.reset({answer.stops}));
    return answer.verdict;
  };
  EXPECT_EQ(verdict_on([](auto& w) { w.sampling = sampling{2}; }), verdict::no_such_choice);
  EXPECT_EQ(verdict_on([](auto& w) { w.controller = controller{2}; }), verdict::no_such_choice);
  EXPECT_EQ(verdict_on([](auto& w) { w.sampling = sampling::on_command; }), verdict::no_such_choice);
  EXPECT_EQ(verdict_on([](auto& w) { w.period = 99'999; }), verdict::period_too_short);
  EXPECT_EQ(verdict_on([](auto& w) { w.safe_damping = -1; }), verdict::damping_out_of_range);
  EXPECT_EQ(verdict_on([](auto& w) { w.safe_damping = 30.1F; }), verdict::damping_out_of_range);
  EXPECT_EQ(verdict_on([](auto& w) { w.safe_damping = nan; }), verdict::damping_out_of_range);
  EXPECT_EQ(verdict_on([](auto&) {}, 0), verdict::no_model);
  EXPECT_EQ(verdict_on([](auto&) {}, 500'000), verdict::model_period_differs);
}

// A new session must find a quiet board, whatever the last one left, and be numbered from wherever it begins.
TEST(Supervisor, ConfigureStopsWhateverRuns) {
  supervisor board = running();
  board.obey(1000, {1.0F, 20.0F});
  const configured_message answer = board.configure(wish());
  EXPECT_EQ(seen(board).state, board_state::idle);
  expect_applied(board, 0, 4.0F);
  board.reset({answer.stops});
  EXPECT_TRUE(board.obey(0, {1.0F, 20.0F}));
  expect_applied(board, 1.0F, 20.0F);
}

// Every comparison with NaN is false, and a negative limit might be taken for "none": a limit that was meant would then
// be off.
TEST(Supervisor, RefusesASpeedLimitThatIsNone) {
  for (const controller who : {controller::host, controller::own_model}) {
    for (const float bad : {nan, -0.5F, infinite}) {
      supervisor board(facts(1'000'000), 5.0F);
      configure_message asked = wish(who);
      asked.max_speed = bad;
      const configured_message answer = board.configure(asked);
      EXPECT_EQ(answer.verdict, verdict::speed_limit_wrong);
      EXPECT_FALSE(board.reset({answer.stops}));
    }
  }
}

// A jump is a sensor that lies: the own model must not make a force of it, with a speed limit or without.
TEST(Supervisor, StopsWhenTheEncoderJumps) {
  supervisor board = running(controller::own_model);  // 0.5 m/s, 1 ms, 10 µm a count: 50 counts, and one of rounding
  EXPECT_TRUE(board.accept_move(51, 1));
  EXPECT_TRUE(board.accept_move(-101, 2));
  EXPECT_FALSE(board.accept_move(-52, 1));
  expect_stopped(board, stop_cause::encoder_jump);
  supervisor unlimited(facts(1'000'000), 5.0F);
  configure_message asked = wish(controller::own_model);
  asked.max_speed = 0;
  unlimited.reset({unlimited.configure(asked).stops});
  EXPECT_TRUE(unlimited.accept_move(1 << 29, 1));
  EXPECT_FALSE(unlimited.accept_move(-(1 << 30), 1)) << "as likely a wrap as a move";
  expect_stopped(unlimited, stop_cause::encoder_jump);
}

// Commands that begin to count anew come from a host that was restarted, or from a replay: neither may drive what the
// host before them has started.
TEST(Supervisor, StopsWhenCommandsBeginAnew) {
  supervisor board = running();
  for (std::uint32_t i = 9'000; i < 9'100; ++i) board.obey(i, {1.0F, 20.0F});
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_FALSE(board.obey(i, {2.0F, 20.0F}));
  expect_applied(board, 1.0F, 20.0F);
  EXPECT_TRUE(board.obey(3, {2.0F, 20.0F}));
  expect_stopped(board, stop_cause::commands_anew);
}

// One number beyond reason must not make the board deaf to the commands that would let go of the handle.
TEST(Supervisor, ObeysZeroAfterAWildNumber) {
  supervisor board = running();
  for (std::uint32_t i = 0; i < 10; ++i) board.obey(i, {1.0F, 20.0F});
  EXPECT_FALSE(board.obey(0x4000'0000U, {2.0F, 20.0F}));
  EXPECT_TRUE(board.obey(10, {0, 4.0F}));
  expect_applied(board, 0, 4.0F);
}

}  // namespace
}  // namespace dashpot::board
