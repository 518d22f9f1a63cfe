#include "ball.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "chosen.hpp"
#include "says.hpp"

namespace {

using namespace dashpot::paper;

const Ball& ball() {
  static const Ball measured = measure_ball();
  return measured;
}

// Fails if a Prony series on components does not give F r ω²λ/(ω² + λ²), 0.1 W for 1 N, 20 mm and 10 rad/s. What
// holding its force for a period takes, ½ F r ω²T of what is not along the slide, is up to 2 % of it at 40 rad/s.
TEST(Ball, GivesPowerByComponents) {
  EXPECT_NEAR(ball().slides.front().component_power, -0.1, 0.0005);
  for (const Ball::Slide& slide : ball().slides) {
    EXPECT_NEAR(slide.component_power, slide.expected, 0.021 * -slide.expected) << slide.speed;
    EXPECT_LT(slide.component_power, slide.expected + slide.held * 3) << slide.speed;
  }
}

// Fails if the emitted law gives power as the tool slides, or takes more than what is held for a period does: ½ F r ω²T
// of the force, and of the brakes on x and y, which turn to the tangent by (ωT)² between them, no more than b
// v²(ωT)²/4.
TEST(Ball, GivesNothingByDepth) {
  const double damping = chosen("ball.damper"), radius = chosen("ball.radius") - chosen("ball.depth"), period = 1e-4;
  for (const Ball::Slide& slide : ball().slides) {
    const double turn = slide.speed * period, velocity = slide.speed * radius;
    EXPECT_GT(slide.depth_power, slide.held * (1 - 1e-3)) << slide.speed;
    EXPECT_LT(slide.depth_power, slide.held * (1 + 1e-3) + damping * velocity * velocity * turn * turn / 4)
        << slide.speed;
  }
}

// Fails if some of the emitted law's force is along the slide, at any sample: rounding of 1 N, and of the 20 N s/m of
// brakes that the motors take back, is 1e-15 of that.
TEST(Ball, PushesStraightOutwards) {
  for (const Ball::Slide& slide : ball().slides)
    for (const ArmSample& s : slide.by_depth) {
      const double x = s.commanded.torque[0] + s.commanded.damping[0] * s.tip_velocity[0];
      const double y = s.commanded.torque[1] + s.commanded.damping[1] * s.tip_velocity[1];
      ASSERT_LT(std::abs(y * s.tip[0] - x * s.tip[1]), 1e-13 * std::hypot(s.tip[0], s.tip[1])) << slide.speed;
    }
}

// Fails if at any time more energy has come out than was put in. Held forces of a press give nothing: they are of the
// sample before, and smaller on the way in.
TEST(Ball, NeverHasGivenMoreThanItTook) {
  for (const Ball::Slide& slide : ball().slides) {
    EXPECT_GE(least_taken(slide.by_depth), -1e-15) << slide.speed;
    EXPECT_LT(least_taken(slide.by_components), -0.01) << slide.speed;
  }
}

// Fails if the words stay when the numbers change sides.
TEST(Ball, SaysWhatTheNumbersSay) {
  EXPECT_TRUE(says(show(ball()), "components of the force gives 0.100 W"));
  EXPECT_TRUE(says(show(ball()), "it gives no energy"));
  Ball other = ball();
  other.slides[0].component_power = 0.1, other.slides[0].depth_power = -1e-6;
  EXPECT_TRUE(says(show(other), "components of the force takes 0.100 W"));
  EXPECT_TRUE(says(show(other), "it gives energy"));
}

}  // namespace
