#include "application.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "in_process_board.hpp"
#include "stepped_session.hpp"
#include "stream_pair.hpp"

namespace dashpot::board {
namespace {

// The host's end of the stream, frame by frame.
class listener {
 public:
  explicit listener(transport stream) : stream_(std::move(stream)) {}

  template <class Message>
  void say(const Message& message, std::uint32_t sequence = 0) {
    const encoded_frame frame = encode(message, sequence);
    ASSERT_EQ(stream_.write(frame.bytes, frame.size), frame.size);
  }

  // Every message of this kind that has come; the others are forgotten.
  template <class Message>
  std::vector<Message> hear() {
    std::vector<Message> heard;
    std::uint8_t bytes[4096];
    while (const std::size_t count = stream_.read(bytes, sizeof bytes)) {
      for_each_frame(decoder_, bytes, count, [&](const frame& from) {
        if (from.type == Message::type) heard.push_back(decode<Message>(from));
      });
    }
    return heard;
  }

 private:
  transport stream_;
  frame_decoder decoder_;
};

struct conversation {
  stream_pair ends = connected_pair();
  listener host{std::move(ends.near)};
  in_process_board<> board{std::move(ends.far)};

  void start(const configure_message& wish) {
    host.say(wish);
    board.serve();
    host.say(reset_message{host.hear<configured_message>().at(0).stops});
    board.serve();
  }
};

constexpr configure_message own_model = {1'000'000, 4, 0, 0, sampling::free_running, controller::own_model};
constexpr configure_message on_command = {1'000'000, 4, 0, 5, sampling::on_command, controller::host};

// The host decides by this answer whether it talks to the device it was compiled for.
TEST(Application, DescribesItselfAndItsModel) {
  conversation talk;
  talk.host.say(hello_message());
  talk.board.serve();
  const auto answers = talk.host.hear<description_message>();
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].encoder_step, 1e-5);
  EXPECT_EQ(answers[0].model_period, 1'000'000U);
}

// One command, one sample: anything else would make the host's loop see samples that it did not pace.
TEST(Application, SamplesOnceForEachNewCommand) {
  conversation talk;
  talk.start(on_command);
  talk.host.hear<sample_message>();
  for (std::uint32_t i = 0; i < 10; ++i) talk.host.say(command_message{1, 2}, i);
  talk.host.say(command_message{1, 2}, 9);
  talk.host.say(command_message{1, 2}, 3);
  talk.board.serve();
  talk.board.pass_period();
  const auto samples = talk.host.hear<sample_message>();
  ASSERT_EQ(samples.size(), 10U);
  for (std::uint32_t i = 0; i < 10; ++i) EXPECT_EQ(samples[i].command_sequence, i);
  EXPECT_EQ(samples[9].motor_torque, 1.0F);
  EXPECT_EQ(samples[9].brake_damping, 2.0F);
}

// Free running, the board's clock paces the samples, and a period slept through must show in the statistics.
TEST(Application, SamplesOnceEachPeriodWhenFreeRunning) {
  conversation talk;
  talk.start(own_model);
  talk.host.hear<sample_message>();
  for (int i = 0; i < 10; ++i) talk.board.pass_period();
  EXPECT_EQ(talk.host.hear<sample_message>().size(), 10U);
  talk.board.pass_period(3);
  EXPECT_EQ(talk.host.hear<sample_message>().size(), 1U);
  talk.host.say(ask_statistics_message());
  talk.board.serve();
  EXPECT_EQ(talk.host.hear<statistics_message>().at(0).missed_periods, 2U);
}

// Periods slept through are silence too: a board that stalls must not keep the motor on for longer.
TEST(Application, CountsSleptPeriodsAsSilence) {
  conversation talk;
  talk.start(on_command);
  talk.host.say(command_message{1, 2}, 0);
  talk.board.serve();
  EXPECT_EQ(talk.board.hardware().driven().motor_torque, 1.0F);
  talk.board.pass_period(5);
  EXPECT_EQ(talk.board.hardware().driven().motor_torque, 0.0F);
  EXPECT_EQ(talk.board.hardware().driven().brake_damping, 4.0F);
}

// The emitted model must get the position and the velocity that it was compiled for, and its force must oppose them.
TEST(Application, RunsTheModelOnCounts) {
  conversation talk;
  talk.start(own_model);
  talk.host.hear<sample_message>();
  std::vector<sample_message> samples;
  for (int i = 0; i < 500; ++i) {
    talk.board.pass_period();
    for (const sample_message& sample : talk.host.hear<sample_message>()) samples.push_back(sample);
  }
  ASSERT_EQ(samples.size(), 500U);
  generated::stand_in_model model;
  const std::int32_t start = samples[0].counts;
  model.reset(static_cast<float>(start) * 1e-5F);
  backward_difference<float> estimator(1, 0.001);
  estimator.reset(0);
  for (const sample_message& sample : samples) {
    const float velocity = estimator.update(static_cast<float>(sample.counts - start) * 1e-5F);
    const auto expected = model.step(static_cast<float>(sample.counts) * 1e-5F, velocity);
    ASSERT_EQ(sample.motor_torque, -expected.force);
    ASSERT_EQ(sample.brake_damping, expected.damping);
  }
  EXPECT_GT(samples.back().counts, start + 100);
}

// A translational network at the tool of a rotary joint: K r², B r², torque = F r (theory, section 7).
TEST(ModelRunner, ConvertsBetweenToolAndJoint) {
  constexpr float radius = 0.05F, step = 1e-4F;
  model_runner<generated::stand_in_model> runner(static_cast<double>(step), {}, radius);
  runner.step({0, 0, 0});
  const model_answer answer = runner.step({3, 1'000'000, 0});
  generated::stand_in_model model;
  model.reset(0);
  model.step(0, 0);
  const float speed = 3.0F * step * 1000.0F;
  const auto at_tool = model.step(3.0F * step * radius, speed * radius);
  EXPECT_EQ(answer.speed, speed);
  EXPECT_EQ(answer.wish.motor_torque, -at_tool.force * radius);
  EXPECT_EQ(answer.wish.brake_damping, at_tool.damping * radius * radius);
}

// A model certified with a smooth velocity would be active on a raw one: the board must use the estimator it is told
// to.
TEST(ModelRunner, EstimatesTheVelocityAsDescribed) {
  velocity_description smooth;
  smooth.estimator = estimator_kind::butterworth;
  smooth.cutoff = 120;
  model_runner<generated::stand_in_model> runner(1e-5, smooth, 1);
  any_estimator<float> expected(smooth, 0.001, 1e-5);
  expected.reset(0);
  for (std::int32_t counts = 0; counts < 100; counts += 7) {
    device_sample sample;
    sample.position = static_cast<double>(static_cast<float>(counts) * 1e-5F);
    EXPECT_EQ(runner.step({counts, 0, 0}).speed, expected.update(sample));
  }
}

// With an estimator that times the encoder's edges, a clock that is cut short, or wraps within the run, would show a
// speed that is not there.
TEST(ModelRunner, TimesEdgesByTheWholeClockAndOverItsWrap) {
  velocity_description timed;
  timed.estimator = estimator_kind::inverse_time;
  const auto speeds = [&](std::uint64_t begin) {
    model_runner<generated::stand_in_model> runner(1e-5, timed, 1);
    std::vector<float> all;
    for (std::uint32_t k = 0; k < 100; ++k) {
      const std::uint64_t now = begin + k * 1'000'000U;
      const std::uint64_t edge = now - k % 3 * 1'000'000U - 40'000U;
      all.push_back(runner.step({static_cast<std::int32_t>(k / 3 * 2), now, edge}).speed);
    }
    return all;
  };
  const std::vector<float> young = speeds(1'000'000'000U);
  EXPECT_NEAR(young.back(), 2e-5 / 3e-3, 1e-4);
  EXPECT_EQ(speeds(0U - 50 * std::uint64_t{1'000'000}), young);
  EXPECT_EQ(speeds((std::uint64_t{1} << 32) - 50'500'000U), young);
}

struct certified_for_a_filter {
  struct certified_for {
    static constexpr bool any_device = false;
    static constexpr const char* estimator = "butterworth";
  };
};
// The firmware does not compile with a model that was certified for another estimator.
static_assert(is_certified_for<certified_for_a_filter>(estimator_kind::butterworth));
static_assert(!is_certified_for<certified_for_a_filter>(estimator_kind::backward_difference));
static_assert(is_certified_for<generated::stand_in_model>(estimator_kind::kalman));

// The counts wrap around after 2³² steps: the velocity must not jump there.
TEST(ModelRunner, CrossesTheEndOfTheCounter) {
  model_runner<generated::stand_in_model> runner(1e-5, {}, 1);
  runner.step({std::numeric_limits<std::int32_t>::max(), 0, 0});
  EXPECT_EQ(runner.step({std::numeric_limits<std::int32_t>::min() + 1, 1'000'000, 0}).speed, 2.0F * 1e-5F * 1000.0F);
}

// At the end of the counter a position from raw counts goes from 21 km to −21 km: the spring would pull with all that
// the motor has. And single precision, 21 km away, is a step of 2 mm, or of 2 N.
TEST(ModelRunner, HoldsASpringOverTheEndOfTheCounter) {
  constexpr std::int32_t last = std::numeric_limits<std::int32_t>::max();
  model_runner<spring_from_start<float>> runner(1e-5, {}, 1);
  for (std::int64_t moved = 0; moved < 200; ++moved) {
    const auto counts =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(last - 100) + static_cast<std::uint32_t>(moved));
    const float torque = runner.step({counts, 0, 0}).wish.motor_torque;
    ASSERT_EQ(torque, -1000.0F * (static_cast<float>(moved) * 1e-5F)) << moved;
  }
}

// The whole board, from idle through running, with the counter over its end on the way and a fault in between.
TEST(Application, FollowsTheCounterOverItsEndInEveryState) {
  model_runner<spring_from_start<float>> runner(1e-5, {}, 1);
  runner.watch({std::numeric_limits<std::int32_t>::max() - 1, 0, 0});
  runner.watch({std::numeric_limits<std::int32_t>::min() + 1, 0, 0});  // idle: three counts further
  EXPECT_EQ(runner.step({std::numeric_limits<std::int32_t>::min() + 1, 0, 0}).wish.motor_torque, 0);
  EXPECT_EQ(runner.watch({std::numeric_limits<std::int32_t>::min() + 3, 0, 0}).counts, 2);
  runner.restart();
  EXPECT_EQ(runner.watch({std::numeric_limits<std::int32_t>::min() + 9, 0, 0}).counts, 0) << "a run may begin anywhere";
}

// Near zero the board's own model and a host must mean the same place by the same counts.
TEST(ModelRunner, HasItsZeroWhereTheCounterHasIt) {
  model_runner<generated::stand_in_model> runner(1e-5, {}, 1);
  generated::stand_in_model model;
  model.reset(3e-2F);
  EXPECT_EQ(runner.step({3000, 0, 0}).wish.motor_torque, -model.step(3000.0F * 1e-5F, 0).force);
}

}  // namespace
}  // namespace dashpot::board
