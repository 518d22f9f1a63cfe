#include "fig11.hpp"

#include <gtest/gtest.h>

#include "says.hpp"
#include "chosen.hpp"

namespace {

using namespace dashpot::paper;

const Fig11& fig11() {
  static const Fig11 measured = measure_fig11();
  return measured;
}

// Fails if the motor's command does not jump where sliding begins after a reversal, by B2 times the estimate, as the
// paper shows.
TEST(Fig11, JumpsAfterEachReversalByTheMotorAlone) {
  EXPECT_EQ(fig11().reversals.size(), 6U);
  EXPECT_NEAR(fig11().parts[0].jump, 0.0203, 0.002);
}

// Fails if the jump is not gone from the motor's command with the brake: what is left is the spring's force of some
// encoder steps.
TEST(Fig11, DoesNotJumpByMotorAndBrake) {
  const double step = chosen("needle.stiffness") * rig().description.encoder.step * rig().description.arm_radius;
  EXPECT_LT(fig11().parts[1].jump, 2.5 * step);
}

// Fails if the brake does not improve what is felt, after reversals and over the whole run.
TEST(Fig11, ErrsLessByMotorAndBrake) {
  EXPECT_LT(fig11().parts[1].spike, fig11().parts[0].spike);
  EXPECT_LT(fig11().parts[1].rms_error, fig11().parts[0].rms_error / 2);
}

// Fails if the errors are others than the page reports; without dampers it is nearly the dampers' force itself.
TEST(Fig11, ErrsByWhatThePageSays) {
  EXPECT_NEAR(fig11().parts[0].rms_error, 4.7e-3, 0.3e-3);
  EXPECT_NEAR(fig11().parts[1].rms_error, 1.8e-3, 0.3e-3);
  EXPECT_NEAR(fig11().parts[2].rms_error, 0.159, 0.005);
}

// Fails if dashpot's default is further from the network than the law of the paper's rule, or than a tenth of what
// (21) by the motor alone and by both leave between them.
TEST(Fig11, ErrsLessFaithfullyThanByThePapersRule) {
  EXPECT_LT(fig11().parts[4].rms_error, fig11().parts[3].rms_error / 2);
  EXPECT_NEAR(fig11().parts[4].rms_error, fig11().parts[1].rms_error, 0.3e-3);
}

// Fails if the 20 mN cannot be seen: a residual is drawn over no more than some of them.
TEST(Fig11, DrawsResidualsInMillinewtons) {
  int residuals = 0;
  for (const Panel& panel : show(fig11()).figures.at(0).panels)
    if (panel.y_label == "force [mN]") {
      ++residuals;
      EXPECT_LE(panel.y_range->high - panel.y_range->low, 60) << panel.title;
    }
  EXPECT_EQ(residuals, 2);
}

// Fails if the words stay when the numbers change sides.
TEST(Fig11, SaysWhatTheNumbersSay) {
  EXPECT_TRUE(says(show(fig11()), "the brake eliminates: that comes out"));
  EXPECT_TRUE(says(show(fig11()), "considerably” comes out"));
  Fig11 other = fig11();
  other.parts[1].jump = other.parts[0].jump;
  EXPECT_TRUE(says(show(other), "the brake eliminates: that does not come out"));
  other.parts[1].rms_error = other.parts[0].rms_error;
  EXPECT_TRUE(says(show(other), "considerably” does not come out"));
  other.parts[3].rms_error = 0;
  EXPECT_TRUE(says(show(other), "dashpot, the paper’s rule is nearest to the network"));
}

}  // namespace
