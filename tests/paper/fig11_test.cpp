#include "fig11.hpp"

#include <gtest/gtest.h>

#include "chosen.hpp"

namespace {

using namespace dashpot::paper;

const Fig11& fig11() {
  static const Fig11 measured = measure_fig11();
  return measured;
}

// Fails if the motor's command does not jump where sliding begins after a reversal, by B2 times the estimate, as the
// paper shows.
TEST(Fig11, jumps_after_each_reversal_by_the_motor_alone) {
  EXPECT_EQ(fig11().reversals.size(), 6U);
  EXPECT_NEAR(fig11().parts[0].jump, 0.0203, 0.002);
}

// Fails if the jump is not gone from the motor's command with the brake: what is left is the spring's force of some
// encoder steps.
TEST(Fig11, does_not_jump_by_motor_and_brake) {
  const double step = chosen("needle.stiffness") * rig().description.encoder.step * rig().description.arm_radius;
  EXPECT_LT(fig11().parts[1].jump, 2.5 * step);
}

// Fails if the brake does not improve what is felt, after reversals and over the whole run.
TEST(Fig11, errs_less_by_motor_and_brake) {
  EXPECT_LT(fig11().parts[1].spike, fig11().parts[0].spike);
  EXPECT_LT(fig11().parts[1].rms_error, fig11().parts[0].rms_error / 2);
}

// Fails if the errors are others than the page reports; without dampers it is nearly the dampers' force itself.
TEST(Fig11, errs_by_what_the_page_says) {
  EXPECT_NEAR(fig11().parts[0].rms_error, 4.7e-3, 0.3e-3);
  EXPECT_NEAR(fig11().parts[1].rms_error, 1.8e-3, 0.3e-3);
  EXPECT_NEAR(fig11().parts[2].rms_error, 0.159, 0.005);
}

}  // namespace
