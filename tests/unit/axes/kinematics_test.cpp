// Arms: positions by hand, Jacobians and Hessians against differences, and enclosures of both.
#include <gtest/gtest.h>

#include "arms.hpp"
#include "axes/curvature.hpp"

namespace dashpot::testing {
namespace {

Pair<double> tip(const Arm& arm, double q1, double q2) { return pose(arm, Pair<double>{q1, q2}).tip; }

void expect_near(const Pair<double>& a, const Pair<double>& b, double error) {
  EXPECT_NEAR(a[0], b[0], error);
  EXPECT_NEAR(a[1], b[1], error);
}

// Angles mean what kinematics.hpp says: else a law would push elsewhere.
TEST(Kinematics, TipsByHand) {
  expect_near(tip(serial_arm, 0, pi / 2), {63e-3, 75e-3}, 1e-16);
  expect_near(tip(serial_arm, pi / 2, pi / 2), {-75e-3, 63e-3}, 1e-16);
  expect_near(tip(parallelogram_arm, 0, pi / 2), {63e-3, 75e-3}, 1e-16);
  expect_near(tip(parallelogram_arm, pi / 2, pi), {-75e-3, 63e-3}, 1e-16);
  expect_near(tip(Arm{}, 1e-3, 2e-3), {1e-3, 2e-3}, 0);
  // Elbows straight out to both sides, at a distance of 2·63 + 25 = 151 mm: too far for links of 75 mm, just right for
  // 100 mm.
  const Arm wide{Kinematics::five_bar, 63e-3, 100e-3, 25e-3};
  expect_near(tip(wide, pi, 0), {0, std::sqrt(100e-3 * 100e-3 - 75.5e-3 * 75.5e-3)}, 1e-16);
  // Coaxial: along the bisector.
  const double apart = 0.8, lean = 1.9;
  const double out = 70e-3 * std::cos(apart) + std::sqrt(90e-3 * 90e-3 - std::pow(70e-3 * std::sin(apart), 2));
  expect_near(tip(coaxial_arm, lean + apart, lean - apart), {out * std::cos(lean), out * std::sin(lean)}, 1e-16);
}

// Both distal links of a five-bar end at the tip.
TEST(Kinematics, FiveBarCloses) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Pair<double> wanted = random_tip(random);
    const Pair<double> q = *joints_at(five_bar_arm, wanted);
    const Pair<double> left{-12.5e-3 + 63e-3 * std::cos(q[0]), 63e-3 * std::sin(q[0])};
    const Pair<double> right{12.5e-3 + 63e-3 * std::cos(q[1]), 63e-3 * std::sin(q[1])};
    const Pair<double> reached = tip(five_bar_arm, q[0], q[1]);
    EXPECT_NEAR(std::hypot(reached[0] - left[0], reached[1] - left[1]), 75e-3, 1e-16);
    EXPECT_NEAR(std::hypot(reached[0] - right[0], reached[1] - right[1]), 75e-3, 1e-16);
    expect_near(reached, wanted, 1e-15);
    EXPECT_LT(left[0], right[0]);
  }
}

// Columns of J and both Hessians are what differences over 10 and 100 µrad show, to their truncation and rounding: a
// fifth of a micrometre per radian, and 1e-6 m/rad², of arms that bend by less than 10 m/rad³.
TEST(Kinematics, DerivativesAreThoseOfTheTip) {
  Random random(4);
  for (const Arm& arm : every_arm) {
    for (int i = 0; i < 100; ++i) {
      const Pair<double> q = *joints_at(arm, random_tip(random));
      const Pose<double> at = pose(arm, q);
      const Pair<Symmetric<double>> bent = curvature(arm, q);
      for (const std::size_t j : {0u, 1u}) {
        Pair<double> ahead = q, behind = q;
        ahead[j] += 1e-5, behind[j] -= 1e-5;
        const Pose<double> next = pose(arm, ahead), last = pose(arm, behind);
        expect_near(5e4 * (next.tip - last.tip), at.column[j], 1e-9);
        for (const std::size_t x : {0u, 1u}) {
          EXPECT_NEAR(5e4 * (next.column[0][x] - last.column[0][x]), j == 0 ? bent[x].xx : bent[x].xy, 1e-8);
          EXPECT_NEAR(5e4 * (next.column[1][x] - last.column[1][x]), j == 0 ? bent[x].xy : bent[x].yy, 1e-8);
        }
      }
      EXPECT_NEAR(std::abs(determinant(arm, q)),
                  std::abs(at.column[0][0] * at.column[1][1] - at.column[0][1] * at.column[1][0]),
                  1e-12 * std::abs(determinant(arm, q)));
      EXPECT_GT(determinant(arm, q), 0);
    }
  }
}

// The same text over boxes of joints encloses every member's tip, columns and curvature.
TEST(Kinematics, BoxesEncloseTheirMembers) {
  Random random(5);
  for (const Arm& arm : every_arm) {
    for (int i = 0; i < 200; ++i) {
      const Pair<double> from = *joints_at(arm, random_tip(random));
      const double width = random.log_uniform(1e-12, 0.1);
      const Box box{Interval(from[0], from[0] + width), Interval(from[1] - width, from[1])};
      const Pair<double> q{from[0] + random.uniform() * width, from[1] - random.uniform() * width};
      const Pose<double> at = pose(arm, q);
      const Pose<Interval> over = pose(arm, box);
      const Pair<Symmetric<double>> bent = curvature(arm, q);
      const Pair<Symmetric<Interval>> bends = curvature(arm, box);
      for (const std::size_t x : {0u, 1u}) {
        // What the doubles round off themselves.
        const auto holds = [](const Interval& a, double v) { return widened(a, 1e-13).holds(v); };
        EXPECT_TRUE(holds(over.tip[x], at.tip[x]));
        EXPECT_TRUE(holds(over.column[0][x], at.column[0][x]) && holds(over.column[1][x], at.column[1][x]));
        EXPECT_TRUE(holds(bends[x].xx, bent[x].xx) && holds(bends[x].xy, bent[x].xy) && holds(bends[x].yy, bent[x].yy));
      }
    }
  }
}

}  // namespace
}  // namespace dashpot::testing
