// What a firmware that runs a model of its own does, done on this machine; and a conversation with such a firmware,
// frame by frame.
#pragma once

#include <bit>
#include <utility>

#include <gtest/gtest.h>

#include <dashpot/board/link.hpp>

#include "model_runner.hpp"

namespace dashpot::board {

// Does what the board does, sample by sample from configure on. A frame that the board had no room to send costs a
// comparison, not the run: what came of that step shows in every later one.
template <class Model, class Plant>
class twin {
  static constexpr unsigned axes = Plant::axes;

 public:
  twin(const basic_configure_message<axes>& configured, const model_runner<Model>& runner)
      : period_(static_cast<float>(configured.period) * 1e-9F), runner_(runner) {
    for (unsigned i = 0; i < brakes_of<axes>; ++i) nth(driven_.brake_damping, i) = nth(configured.safe_damping, i);
  }

  void expect_same(std::uint32_t sequence, const basic_sample_message<axes>& sample) {
    while (next_ != sequence) pass_unseen();
    ++next_;
    const bool answers_reset = sample.state == board_state::running && !running_;
    if (!answers_reset) advance();
    for (unsigned j = 0; j < axes; ++j) ASSERT_EQ(nth(sample.counts, j), plant_.counts(j));
    if (running_) step();
    running_ = sample.state == board_state::running;
    bool pulls = true;
    for (unsigned j = 0; j < axes; ++j) {
      expect_bits(nth(sample.motor_torque, j), nth(driven_.motor_torque, j));
      pulls = pulls && nth(driven_.motor_torque, j) != 0;
    }
    for (unsigned i = 0; i < brakes_of<axes>; ++i)
      expect_bits(nth(sample.brake_damping, i), nth(driven_.brake_damping, i));
    if (pulls) ++compared_with_torque_;
  }

  int steps() const { return steps_; }
  int compared_with_torque() const { return compared_with_torque_; }  // of every motor

 private:
  static void expect_bits(float seen, float wanted) {
    ASSERT_EQ(std::bit_cast<std::uint32_t>(seen), std::bit_cast<std::uint32_t>(wanted));
  }
  void pass_unseen() {
    ++next_;
    advance();
    if (running_) step();
  }
  void advance() { plant_.advance(driven_, period_); }
  void step() {
    basic_encoder_reading<axes> reading;
    for (unsigned j = 0; j < axes; ++j) nth(reading.counts, j) = plant_.counts(j);
    driven_ = runner_.step(reading).wish;
    ++steps_;
  }

  float period_;  // [s]
  Plant plant_;
  basic_outputs<axes> driven_;
  model_runner<Model> runner_;
  bool running_ = false;
  std::uint32_t next_ = 0;  // sequence number of the sample to come
  int steps_ = 0;
  int compared_with_torque_ = 0;
};

// Waits for messages over the raw link: every frame counts here, not only the newest sample.
class conversation {
 public:
  explicit conversation(transport stream) : link_(std::move(stream)) {}

  template <class Message>
  void say(const Message& message) {
    ASSERT_TRUE(link_.send(message));
  }

  // Shows every frame to `handle` until it returns true for one; false when the other end hangs up before.
  template <class Handle>
  bool listen(Handle&& handle) {
    bool done = false;
    while (!done && !link_.closed()) {
      link_.stream().wait_readable(1000);
      link_.receive([&](const frame& one) { done = done || handle(one); });
    }
    return done;
  }

  template <class Message>
  Message answer() {
    Message heard;
    const bool came = listen([&](const frame& one) {
      if (one.type != Message::type) return false;
      heard = decode<Message>(one);
      return true;
    });
    EXPECT_TRUE(came);
    return heard;
  }

 private:
  link link_;
};

// Runs the board's own model for `steps` steps beside its twin.
template <class Model, class Plant>
void expect_the_same_bits(transport stream, const basic_configure_message<Plant::axes>& wish,
                          const model_runner<Model>& runner, int steps) {
  conversation talk(std::move(stream));
  talk.say(wish);
  const auto configured = talk.answer<configured_message>();
  ASSERT_EQ(configured.verdict, verdict::accepted);
  talk.say(reset_message{configured.stops});

  using sample_type = basic_sample_message<Plant::axes>;
  twin<Model, Plant> host(wish, runner);
  const bool finished = talk.listen([&](const frame& one) {
    if (one.type == sample_type::type) host.expect_same(one.sequence, decode<sample_type>(one));
    return host.steps() >= steps || ::testing::Test::HasFailure();
  });
  EXPECT_TRUE(finished);
  EXPECT_FALSE(::testing::Test::HasFailure()) << "in step " << host.steps();
  EXPECT_GT(host.compared_with_torque(), steps / 2) << "equal zeros would prove little";
}

}  // namespace dashpot::board
