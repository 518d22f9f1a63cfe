// The firmware running a model of its own, against the same model and plant on this machine.
#include <bit>
#include <iostream>

#include <gtest/gtest.h>

#include <dashpot/board/link.hpp>

#include "model_runner.hpp"
#include "qemu_board.hpp"
#include "test_plant.hpp"

#include DASHPOT_BOARD_MODEL_HEADER

namespace dashpot::board {
namespace {

using model = DASHPOT_BOARD_MODEL_CLASS;

constexpr float safe_damping = 4;  // [N·s/m]
constexpr configure_message own_model = {model_runner<model>::period, safe_damping,         0, 0,
                                         sampling::free_running,      controller::own_model};

// Does what the board does, sample by sample from configure on. A frame that the board had no room to send costs a
// comparison, not the run: what came of that step shows in every later one.
class twin {
 public:
  void expect_same(std::uint32_t sequence, const sample_message& sample) {
    while (next_ != sequence) pass_unseen();
    ++next_;
    const bool answers_reset = sample.state == board_state::running && !running_;
    if (!answers_reset) advance();
    ASSERT_EQ(sample.counts, plant_.counts());
    if (running_) step();
    running_ = sample.state == board_state::running;
    ASSERT_EQ(std::bit_cast<std::uint32_t>(sample.motor_torque), std::bit_cast<std::uint32_t>(driven_.motor_torque));
    ASSERT_EQ(std::bit_cast<std::uint32_t>(sample.brake_damping), std::bit_cast<std::uint32_t>(driven_.brake_damping));
    if (driven_.motor_torque != 0) ++compared_with_torque_;
  }

  int steps() const { return steps_; }
  int compared_with_torque() const { return compared_with_torque_; }

 private:
  void pass_unseen() {
    ++next_;
    advance();
    if (running_) step();
  }
  void advance() { plant_.advance(driven_, static_cast<float>(own_model.period) * 1e-9F); }
  void step() {
    driven_ = runner_.step({plant_.counts(), 0, 0}).wish;
    ++steps_;
  }

  test_plant plant_;
  outputs driven_ = {0, safe_damping};
  model_runner<model> runner_{test_plant::encoder_step, {}, 1};
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

// Processor, compiler, encoder, plant, estimator and model in single precision: one bit of difference anywhere, in any
// of 4,000 steps in a closed loop, would show; what is certified on the host would not be what runs on the board.
TEST(Firmware, runs_the_model_bit_for_bit_like_the_host) {
  DASHPOT_SKIP_WITHOUT_QEMU();
  qemu_board board;
  conversation talk(board.connect());
  talk.say(own_model);
  const auto configured = talk.answer<configured_message>();
  ASSERT_EQ(configured.verdict, verdict::accepted);
  talk.say(reset_message{configured.stops});

  twin host;
  const bool finished = talk.listen([&](const frame& one) {
    if (one.type == message_type::sample) host.expect_same(one.sequence, decode<sample_message>(one));
    return host.steps() >= 4000 || ::testing::Test::HasFailure();
  });
  EXPECT_TRUE(finished);
  EXPECT_FALSE(HasFailure()) << "in step " << host.steps();
  EXPECT_GT(host.compared_with_torque(), 2000) << "equal zeros would prove little";
}

// The cost on the target is what decides at which rate a board can run a network: 60 instructions are the budget for
// the network of Fig. 5.
TEST(Firmware, one_step_stays_within_its_budget_of_instructions) {
  DASHPOT_SKIP_WITHOUT_QEMU();
  qemu_board board({"-icount", "shift=0"});
  conversation talk(board.connect());
  talk.say(ask_statistics_message());
  const auto counts = talk.answer<statistics_message>();
  ASSERT_EQ(counts.model_calls, 10'000U);
  constexpr double instructions_per_tick = 40;  // 25 MHz, one instruction a nanosecond
  const double instructions = instructions_per_tick * counts.model_ticks / counts.model_calls;
  std::cout << "instructions per step on a Cortex-M4F: " << instructions << '\n';
  RecordProperty("instructions_per_step", std::to_string(instructions));
  EXPECT_LE(instructions, 60);
  EXPECT_GT(instructions, 5) << "less than the arithmetic alone";
}

}  // namespace
}  // namespace dashpot::board
