// Boards of two axes: what holds for one holds for every joint and brake, and neither board is taken for the other.
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <dashpot/board/board_device.hpp>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>

#include "in_process_board.hpp"
#include "springs_of_arm.hpp"
#include "stepped_session.hpp"
#include "stream_pair.hpp"

namespace dashpot {
namespace {

using namespace board;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

arm_configure_message wish(controller who = controller::host) {
  return {1'000'000,
          {0.004F, 0.006F},
          {0.5F, 0.25F},
          5,
          who == controller::host ? sampling::on_command : sampling::free_running,
          who};
}

arm_description_message facts() {
  arm_description_message stated = facts_of_arm_board().description;
  stated.model_period = 1'000'000;
  stated.max_torque[1] = 0.25F;
  stated.max_damping[1] = 0.04F;
  return stated;
}

arm_supervisor running(controller who = controller::host) {
  arm_supervisor board(facts(), {0.005F, 0.005F, 0, 0});
  board.reset({board.configure(wish(who)).stops});
  return board;
}

void expect_applied(const arm_supervisor& board, const arm_outputs& wanted) {
  for (unsigned j = 0; j < arm_axes; ++j) EXPECT_EQ(board.applied().motor_torque[j], wanted.motor_torque[j]) << j;
  for (unsigned i = 0; i < most_arm_brakes; ++i)
    EXPECT_EQ(board.applied().brake_damping[i], wanted.brake_damping[i]) << i;
}

void expect_stopped(const arm_supervisor& board, stop_cause cause) {
  arm_sample_message seen;
  board.describe(seen);
  EXPECT_EQ(seen.state, board_state::safe);
  EXPECT_EQ(seen.cause, cause);
  expect_applied(board, {{0, 0}, {0.004F, 0.006F}});
}

// A limit that is another joint's, or a damping for a brake that is not there, would reach the hand.
TEST(ArmSupervisor, LimitsEachMotorAndBrakeByItsOwnLimit) {
  arm_supervisor board = running();
  board.obey(0, {{5, -5}, {1, 1, 1, 1}});
  expect_applied(board, {{0.5F, -0.25F}, {0.05F, 0.04F, 0, 0}});
  board.obey(1, {{-0.3F, 0.1F}, {-1, 0.03F}});
  expect_applied(board, {{-0.3F, 0.1F}, {0, 0.03F}});
}

// One NaN or infinite number makes the whole command invalid: half of it would push a tip sideways.
TEST(ArmSupervisor, StopsAllOfItAtOneBadNumber) {
  for (unsigned bad = 0; bad < arm_axes + most_arm_brakes; ++bad) {
    arm_command_message command = {{0.1F, 0.1F}, {0.01F, 0.01F}};
    arm_outputs of_model = {{0.1F, 0.1F}, {0.01F, 0.01F}};
    (bad < arm_axes ? command.motor_torque[bad] : command.brake_damping[bad - arm_axes]) = nan;
    (bad < arm_axes ? of_model.motor_torque[bad] : of_model.brake_damping[bad - arm_axes]) = nan;
    arm_supervisor board = running();
    board.obey(0, {{0.1F, 0.1F}, {0.01F, 0.01F}});
    board.obey(1, command);
    expect_stopped(board, stop_cause::bad_command);
    arm_supervisor alone = running(controller::own_model);
    alone.obey_model(of_model, {});
    expect_stopped(alone, stop_cause::bad_model_command);
  }
}

// Each joint has a limit of its own, and any of them stops the board.
TEST(ArmSupervisor, WatchesTheSpeedOfEveryJoint) {
  for (unsigned j = 0; j < arm_axes; ++j) {
    const float limit = wish().max_speed[j];
    for (const float speed : {limit, 1.01F * limit, -1.01F * limit, nan}) {
      arm_supervisor board = running(controller::own_model);
      float speeds[arm_axes] = {};
      speeds[j] = speed;
      board.obey_model({{0.1F, 0.1F}, {}}, speeds);
      if (speed == limit) EXPECT_TRUE(board.running()) << j;
      else expect_stopped(board, stop_cause::overspeed);
    }
    // 0.5 and 0.25 rad/s, 1 ms, 96 µrad a count: 5 and 2 counts, and one of rounding.
    const std::int32_t farthest = j == 0 ? 6 : 3;
    for (const std::int32_t moved : {farthest, -farthest, farthest + 1, -farthest - 1}) {
      arm_supervisor board = running(controller::own_model);
      std::int32_t counts[arm_axes] = {};
      counts[j] = moved;
      const bool believable = moved >= -farthest && moved <= farthest;
      EXPECT_EQ(board.accept_move(counts, 1), believable) << j << ' ' << moved;
      if (!believable) expect_stopped(board, stop_cause::encoder_jump);
    }
  }
}

TEST(ArmSupervisor, RefusesWhatABrakeOrJointCannotDo) {
  const auto verdict_on = [](auto change) {
    arm_configure_message changed = wish();
    change(changed);
    arm_supervisor board(facts(), {});
    return board.configure(changed).verdict;
  };
  EXPECT_EQ(verdict_on([](auto&) {}), verdict::accepted);
  for (const unsigned brake : {0U, 1U, 2U, 3U})
    for (const float damping : {-0.001F, 0.051F, nan})
      EXPECT_EQ(verdict_on([&](auto& w) { w.safe_damping[brake] = damping; }), verdict::damping_out_of_range);
  EXPECT_EQ(verdict_on([](auto& w) { w.safe_damping[2] = 0.001F; }), verdict::damping_out_of_range) << "no such brake";
  for (const unsigned joint : {0U, 1U})
    for (const float limit : {-0.5F, nan, std::numeric_limits<float>::infinity()})
      EXPECT_EQ(verdict_on([&](auto& w) { w.max_speed[joint] = limit; }), verdict::speed_limit_wrong);
}

using arm_session = stepped_session<no_model, test_arm>;

arm_actuation told() { return {{0.125, -0.25}, {0.015625, 0.03125}}; }

// Joints or brakes that change places on the way would turn every force.
TEST(ArmBoardDevice, CarriesEveryJointAndBrakeToItsOwn) {
  arm_session with(described_arm_board());
  std::string error;
  ASSERT_TRUE(with.start(error)) << error;
  EXPECT_STREQ(with.driver.description_of_board().name, "arm in process");
  EXPECT_EQ(with.board.state().configuration().safe_damping[1], 0.005F);
  arm_sample sample;
  with.write(told());
  for (int i = 0; i < 600; ++i) {
    const arm_reading truth = with.board.hardware().read_encoder();
    ASSERT_EQ(with.read(sample), device_status::ok);
    for (unsigned j = 0; j < arm_axes; ++j) {
      ASSERT_EQ(sample.counts[j], truth.counts[j]);
      ASSERT_EQ(sample.position[j], static_cast<double>(truth.counts[j]) * test_arm::encoder_step);
      ASSERT_EQ(sample.edge_time_ns[j], truth.edge_time[j]);
      ASSERT_EQ(sample.report.applied.motor_torque[j], told().motor_torque[j]);
    }
    ASSERT_EQ(sample.timestamp_ns, truth.timestamp);
    for (unsigned brake = 0; brake < most_arm_brakes; ++brake)
      ASSERT_EQ(sample.report.applied.brake_damping[brake], told().brake_damping[brake]);
    ASSERT_TRUE(sample.report.told || i == 0);  // of number 0 it may not have heard
    with.write(told());
  }
  EXPECT_NE(sample.counts[0], sample.counts[1]);
  EXPECT_EQ(with.board.hardware().driven().motor_torque[1], -0.25F);
  EXPECT_EQ(with.board.hardware().driven().brake_damping[1], 0.03125F);
}

// The counter of either joint turns over by itself.
TEST(ArmBoardDevice, UnwrapsEachCounter) {
  board_age aged;
  aged.counts = std::numeric_limits<std::int32_t>::max() - 24384 - 300;  // the first joint's is about to turn over
  arm_session with(described_arm_board(), {}, facts_of_arm_board(), aged);
  std::string error;
  ASSERT_TRUE(with.start(error)) << error;
  arm_sample sample;
  std::int64_t last[arm_axes] = {};
  bool wrapped = false;
  for (int i = 0; i < 1000; ++i) {
    with.write({});
    ASSERT_EQ(with.read(sample), device_status::ok);
    for (unsigned j = 0; j < arm_axes; ++j) {
      ASSERT_TRUE(i == 0 || std::abs(sample.counts[j] - last[j]) < 100) << j;
      last[j] = sample.counts[j];
    }
    wrapped = wrapped || with.driver.newest_sample().counts[0] < 0;
  }
  EXPECT_TRUE(wrapped);
}

// A NaN or infinite number for any motor or brake must bring all of them to rest.
TEST(ArmBoardDevice, SendsTheSafeCommandInPlaceOfABadOne) {
  for (unsigned bad = 0; bad < arm_axes + most_arm_brakes; ++bad) {
    arm_session with(described_arm_board());
    std::string error;
    ASSERT_TRUE(with.start(error)) << error;
    with.write(told());
    arm_actuation command = told();
    (bad < arm_axes ? command.motor_torque[bad] : command.brake_damping[bad - arm_axes]) = 1e300;
    EXPECT_EQ(with.write(command), device_status::fault);
    EXPECT_EQ(with.board.hardware().driven().motor_torque[0], 0.0F);
    EXPECT_EQ(with.board.hardware().driven().motor_torque[1], 0.0F);
    EXPECT_EQ(with.board.hardware().driven().brake_damping[0], 0.004F);
    EXPECT_EQ(with.board.hardware().driven().brake_damping[1], 0.005F);
  }
}

// What start() says with a board that has this plant to a device file with this number of axes.
template <class Plant, class Described>
std::string outcome(const Described& described, const basic_board_facts<Plant::axes>& facts) {
  stream_pair ends = connected_pair();
  in_process_board<no_model, Plant> board(std::move(ends.far), facts);
  basic_board_device<std::is_same_v<Described, arm_description> ? arm_axes : 1> device(std::move(ends.near), described);
  std::string error;
  const bool started = board.while_serving([&] { return device.start(error); });
  return started ? "started" : error;
}

// Without a message about it a host would wait for an answer that never comes, or drive half of an arm.
TEST(ArmBoardStart, NamesTheAxesThatDiffer) {
  EXPECT_EQ(outcome<test_plant>(described_arm_board(), facts_of_board()),
            "the board has one axis, the device file two");
  EXPECT_EQ(outcome<test_arm>(described_board(), facts_of_arm_board()), "the board has two axes, the device file one");
  EXPECT_EQ(outcome<test_arm>(described_arm_board(), facts_of_arm_board()), "started");
}

// A host of one axis that skips the question, or a replay: the board stays as it is.
TEST(ArmBoardStart, IsDeafToWhatIsForOneAxis) {
  arm_session with(described_arm_board());
  std::string error;
  ASSERT_TRUE(with.start(error)) << error;
  with.write(told());
  arm_sample sample;
  ASSERT_EQ(with.read(sample), device_status::ok);
  with.down = [](byte_string bytes) {
    for (const encoded_frame& foreign :
         {encode(command_message{1, 1}, 1), encode(configure_message{1'000'000, 0.004F, 0, 5}, 0)})
      bytes.insert(bytes.end(), foreign.bytes, foreign.bytes + foreign.size);
    return bytes;
  };
  for (int i = 0; i < 20; ++i) {
    with.write(told());
    ASSERT_EQ(with.read(sample), device_status::ok);
    ASSERT_EQ(with.board.hardware().driven().motor_torque[0], 0.125F);
    ASSERT_EQ(with.board.hardware().driven().brake_damping[0], 0.015625F);
  }
}

template <class Change>
std::string with_facts(Change change) {
  arm_board_facts facts = facts_of_arm_board();
  change(facts.description);
  return outcome<test_arm>(described_arm_board(), facts);
}

// Which joint, or which brake, is what somebody with a screwdriver has to know.
TEST(ArmBoardStart, NamesTheJointOrBrakeThatDiffers) {
  EXPECT_EQ(with_facts([](auto& f) { f.encoder_step[1] = 2e-4; }),
            "encoder step of joint 2 of the board is 0.0002 rad, the device file says 9.58738e-05 rad");
  EXPECT_EQ(with_facts([](auto& f) { f.max_torque[0] = 0.25F; }),
            "largest motor effort of joint 1 of the board is 0.25 N m, the device file says 0.5 N m");
  EXPECT_EQ(with_facts([](auto& f) { f.max_damping[1] = 0; }),
            "largest damping of brake 2 of the board is 0 N m s/rad, the device file says 0.05 N m s/rad");
  EXPECT_EQ(with_facts([](auto& f) { f.max_damping[2] = nan; }), "the board's largest damping of brake 3 is no number");
  EXPECT_EQ(with_facts([](auto& f) { f.motion = motion::translation; }),
            "one of board and device file turns, the other slides");
  EXPECT_EQ(with_facts([](auto& f) { f.max_damping[3] = 1; }), "started") << "a brake more than needed";
}

// The law on the board must get each joint's position and velocity, and its torques must oppose them.
TEST(ArmApplication, RunsALawOfTwoAxesOnCounts) {
  board_options alone;
  alone.sampling = sampling::free_running;
  alone.controller = controller::own_model;
  stepped_session<springs_of_arm<float>, test_arm> with(described_arm_board(), alone);
  std::string error;
  ASSERT_TRUE(with.start(error)) << error;
  springs_of_arm<float> model;
  backward_difference<float> estimators[arm_axes] = {{1, 0.001}, {1, 0.001}};
  std::int32_t start[arm_axes] = {};
  const float step = static_cast<float>(test_arm::encoder_step);
  float largest = 0;
  arm_sample sample;
  with.write({});
  with.read(sample);
  for (int k = 0; k < 1000; ++k) {
    with.write({});
    ASSERT_EQ(with.read(sample), device_status::ok);
    const arm_sample_message& seen = with.driver.newest_sample();
    float position[arm_axes], velocity[arm_axes];
    for (unsigned j = 0; j < arm_axes; ++j) {
      if (k == 0) start[j] = seen.counts[j], estimators[j].reset(0);
      position[j] = static_cast<float>(seen.counts[j]) * step;
      velocity[j] = estimators[j].update(static_cast<float>(seen.counts[j] - start[j]) * step);
    }
    const auto expected = model.step(position, velocity);
    if (k == 0) continue;  // the board's estimate began a sample before
    ASSERT_EQ(seen.motor_torque[1], -expected.torque[1]) << k;
    ASSERT_NEAR(seen.motor_torque[0], -expected.torque[0], 1e-6F) << k;
    ASSERT_EQ(seen.brake_damping[0], 0.01F);
    ASSERT_EQ(seen.brake_damping[1], 0.02F);
    largest = std::max(largest, std::abs(seen.motor_torque[1]));
  }
  EXPECT_GT(largest, 0.01F);
}

arm_description patient_arm() {
  arm_description described = described_arm_board();
  for (device_description& joint : described.joints) joint.loop.delay_samples = 1, joint.encoder.max_speed = 20;
  return described;
}

// Loop, driver and board of two axes from end to end, with what a motor clips, and the watchdog for an end.
TEST(ArmBoardDevice, ServesTheServoLoop) {
  arm_session device(patient_arm());
  std::string error;
  ASSERT_TRUE(device.start(error)) << error;
  springs_of_arm<double> model;
  const any_estimator<double> estimator({}, 0.001, test_arm::encoder_step);
  any_estimator<double> estimators[arm_axes] = {estimator, estimator};
  std::vector<arm_telemetry_record> records;
  arm_servo_options options;
  options.duration = 2;
  options.outputs.log = nullptr;
  options.outputs.observe = [&](const arm_telemetry_record& record) { records.push_back(record); };
  const arm_servo_summary summary = servo_loop(model, device, estimators, options, simulated_clock{}).run();
  EXPECT_EQ(summary.state, servo_state::running) << name_of(summary.last_fault.kind);
  EXPECT_EQ(summary.faults.total() + summary.held + summary.motor_clipped + summary.brake_clipped, 0U);
  EXPECT_TRUE(summary.safe_confirmed);
  ASSERT_EQ(records.size(), 2000U);
  for (unsigned j = 0; j < arm_axes; ++j) {
    EXPECT_GT(summary.highest_positions[j] - summary.lowest_positions[j], 0.01);
    EXPECT_EQ(records.back().sent.motor_torque[j], -records.back().torque[j]);
  }
  EXPECT_GT(summary.energy, 0);
  EXPECT_EQ(device.board.hardware().driven().motor_torque[0], 0.0F);
  EXPECT_EQ(device.board.hardware().driven().brake_damping[1], 0.005F);
}

// The board that falls short on one joint only, and the one that nobody feeds, must both be told by the loop.
TEST(ArmBoardDevice, TellsTheLoopWhatIsClippedAndWhyItStopped) {
  const auto run = [](sampling when, const std::function<void(arm_session&)>& prepare) {
    board_options options_of_board;
    options_of_board.sampling = when;
    arm_session device(patient_arm(), options_of_board);
    std::string error;
    EXPECT_TRUE(device.start(error)) << error;
    prepare(device);
    springs_of_arm<double> model;
    const any_estimator<double> estimator({}, 0.001, test_arm::encoder_step);
    any_estimator<double> estimators[arm_axes] = {estimator, estimator};
    arm_servo_options options;
    options.duration = 1;
    options.outputs.log = nullptr;
    return servo_loop(model, device, estimators, options, simulated_clock{}).run();
  };
  const auto weak = run(sampling::on_command, [](arm_session& with) {
    with.up = [](byte_string bytes) {
      byte_string changed;
      frame_decoder decoder;
      for_each_frame(decoder, bytes.data(), bytes.size(), [&](const frame& one) {
        auto sample = decode<arm_sample_message>(one);
        sample.motor_torque[1] /= 2;
        const encoded_frame again = encode(sample, one.sequence);
        changed.insert(changed.end(), again.bytes, again.bytes + again.size);
      });
      return changed;
    };
  });
  EXPECT_GT(weak.motor_clipped, 500U);
  EXPECT_EQ(weak.brake_clipped, 0U);
  const auto deaf = run(sampling::free_running, [](arm_session& with) {
    with.down = [&with](byte_string bytes) { return with.periods > 400 ? byte_string() : bytes; };
  });
  EXPECT_EQ(deaf.state, servo_state::safe);
  EXPECT_EQ(deaf.last_fault.kind, fault::device_error);
  EXPECT_STREQ(deaf.last_fault.cause, "the board's watchdog: no command came for too long");
}

}  // namespace
}  // namespace dashpot
