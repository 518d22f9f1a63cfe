// The firmware running a model of its own, against the same model and plant on this machine.
#include <iostream>

#include <gtest/gtest.h>

#include "firmware_twin.hpp"
#include "qemu_board.hpp"
#include "test_plant.hpp"

#include DASHPOT_BOARD_MODEL_HEADER

namespace dashpot::board::firmware_model_test {
namespace {

using model = DASHPOT_BOARD_MODEL_CLASS;

constexpr configure_message own_model = {model_runner<model>::period, 4, 0, 0, sampling::free_running,
                                         controller::own_model};

// Processor, compiler, encoder, plant, estimator and model in single precision: one bit of difference anywhere, in any
// of 4,000 steps in a closed loop, would show; what is certified on the host would not be what runs on the board.
TEST(Firmware, RunsTheModelBitForBitLikeTheHost) {
  DASHPOT_SKIP_WITHOUT_QEMU();
  qemu_board board;
  expect_the_same_bits<model, test_plant>(board.connect(), own_model, {test_plant::encoder_step, {}, 1}, 4000);
}

// The cost on the target is what decides at which rate a board can run a network: 60 instructions are the budget for
// the network of Fig. 5.
TEST(Firmware, OneStepStaysWithinItsBudgetOfInstructions) {
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
}  // namespace dashpot::board::firmware_model_test
