#include "fig8.hpp"

#include <gtest/gtest.h>

namespace {

using namespace dashpot::paper;

const Fig8& fig8() {
  static const Fig8 measured = measure_fig8();
  return measured;
}

// Fails if the wall of the literature no longer sticks to a tool that is withdrawn: nearly B u̇ at
// the 94 mm/s of the stroke, over 80 ms.
TEST(Fig8, pulls_by_the_single_motor_with_the_wall_of_the_literature) {
  EXPECT_NEAR(fig8().parts[0].withdrawn.impulse, 8.9e-3, 0.3e-3);
  EXPECT_NEAR(fig8().parts[0].withdrawn.largest_pull, 0.22, 0.01);
}

// Fails if the paper's panel does not come out, in which the dual channel's motor has no spike.
TEST(Fig8, hides_the_pull_from_the_motor_by_the_brake) { EXPECT_EQ(fig8().parts[1].withdrawn.motor_impulse, 0); }

// Fails if the brake did not pull in the motor's place: what the hand feels is no better than with the single motor.
TEST(Fig8, pulls_by_the_brake_as_much_as_by_the_motor) {
  EXPECT_NEAR(fig8().parts[1].withdrawn.impulse, 9.4e-3, 0.3e-3);
  EXPECT_GT(fig8().parts[1].withdrawn.impulse, fig8().parts[0].withdrawn.impulse);
}

// Fails if the recovery of a tool that is let go is not the same curve in both, to a tenth of the depth.
TEST(Fig8, recovers_alike_when_let_go) {
  const Trace &single = fig8().parts[0].trace, &dual = fig8().parts[1].trace;
  for (std::size_t k = 18000; k < single.size(); ++k) ASSERT_NEAR(single[k].position, dual[k].position, 1e-3) << k;
}

}  // namespace
