#include <gtest/gtest.h>

#include <dashpot/servo/servo_state.hpp>

namespace dashpot {
namespace {

constexpr fault_report jump{fault::encoder_jump, 1, 0.5};

servo_state_machine in(servo_state state) {
  servo_state_machine machine;
  if (state != servo_state::idle) machine.start();
  if (state == servo_state::safe) machine.trip(jump);
  return machine;
}

struct arrow {
  servo_state from;
  servo_state start, reset, trip;  // where each leads
};

constexpr arrow arrows[] = {
    {servo_state::idle, servo_state::running, servo_state::idle, servo_state::idle},
    {servo_state::running, servo_state::running, servo_state::running, servo_state::safe},
    {servo_state::safe, servo_state::safe, servo_state::idle, servo_state::safe},
};

// Broken, safe could be left without a reset, or a reset could set the motor going by itself.
TEST(ServoState, HasExactlyTheThreeArrows) {
  for (const arrow& row : arrows) {
    servo_state_machine started = in(row.from), reset = started, tripped = started;
    EXPECT_EQ(started.start(), row.start != row.from);
    EXPECT_EQ(reset.reset(), row.reset != row.from);
    EXPECT_EQ(tripped.trip(jump), row.trip != row.from);
    EXPECT_STREQ(name_of(started.state()), name_of(row.start));
    EXPECT_STREQ(name_of(reset.state()), name_of(row.reset));
    EXPECT_STREQ(name_of(tripped.state()), name_of(row.trip));
  }
}

// Broken, the many faulty periods that follow one fault would each be counted again, or the cause be overwritten.
TEST(ServoState, CountsOnlyTheFaultThatEndedRunning) {
  servo_state_machine machine = in(servo_state::safe);
  machine.trip({fault::no_data, 4, 3});
  EXPECT_EQ(machine.counts().of(fault::encoder_jump), 1u);
  EXPECT_EQ(machine.counts().total(), 1u);
  EXPECT_EQ(machine.last_fault().kind, fault::encoder_jump);
}

// Broken, a run with several faults would report only the newest.
TEST(ServoState, CountsSurviveAReset) {
  servo_state_machine machine = in(servo_state::safe);
  machine.reset();
  machine.start();
  machine.trip({fault::overspeed, 3, 2});
  EXPECT_EQ(machine.counts().of(fault::encoder_jump), 1u);
  EXPECT_EQ(machine.counts().of(fault::overspeed), 1u);
  EXPECT_EQ(machine.last_fault().kind, fault::overspeed);
}

}  // namespace
}  // namespace dashpot
