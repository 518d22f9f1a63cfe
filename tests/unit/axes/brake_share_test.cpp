// How much the brakes make over a workspace: closed forms where there are, and the table of theory, section 12.
#include <gtest/gtest.h>

#include "arms.hpp"
#include "axes/brake_share.hpp"

namespace dashpot::testing {
namespace {

const Brake first{{1, 0}}, second{{0, 1}}, difference{{1, -1}}, sum{{1, 1}};

Symmetric<double> alike_everywhere(const Pair<double>&) { return {5, 0, 5}; }

ShareMap shares(const Arm& arm, const std::vector<Place>& places, const std::vector<Brake>& brakes) {
  return share_map(arm, places, brakes, BrakeRule::non_injecting, alike_everywhere);
}

// Elbows from 30° to 150°; the share is the same in all directions from the base.
std::vector<Place> elbows(const Arm& arm) {
  const double first_joint = 0.7;
  std::vector<Place> places;
  for (int i = 0; i < 3000; ++i) {
    const double elbow = pi / 6 + (i + 0.5) / 3000 * (2 * pi / 3);
    const double joint = arm.kind == Kinematics::serial ? elbow : first_joint + elbow;
    places.push_back({{first_joint, joint}, std::sin(elbow)});
  }
  return places;
}

// `±0.003`: what the table of the theory says of itself; here the sampling errs by less.
void expect_share(const ShareMap& map, double median, double worst) {
  EXPECT_NEAR(map.median, median, 0.003);
  EXPECT_NEAR(map.worst, worst, 0.003);
}

// |c| = cos(q2/2): half of the area lies beyond q2 = 90°, so the median is 1/(1 + cos 45°), and in the worst direction
// (1 − cos 45°)/(1 + cos 45°). A brake on the difference gains nothing, one on the sum all beyond 90°.
TEST(BrakeShare, SerialArm) {
  const Arm arm{Kinematics::serial, 75e-3, 75e-3, 0};
  const std::vector<Place> places = elbows(arm);
  const ShareMap joints = shares(arm, places, {first, second});
  expect_share(joints, 1 / (1 + std::sqrt(0.5)), 1 / (1 + std::cos(pi / 12)));
  EXPECT_NEAR(joints.worst_direction_median, (1 - std::sqrt(0.5)) / (1 + std::sqrt(0.5)), 0.001);
  EXPECT_NEAR(joints.worst_direction_worst, (1 - std::cos(pi / 12)) / (1 + std::cos(pi / 12)), 0.001);
  expect_share(shares(arm, places, {first, second, difference}), joints.median, joints.worst);
  expect_share(shares(arm, places, {first, second, sum}), 1, 0.536);
  expect_share(shares(arm, places, {first, second, difference, sum}), 1, 0.536);
}

// |c| = |cos(θ2 − θ1)|, whose median over the area is half of cos 30°.
TEST(BrakeShare, Parallelogram) {
  const Arm arm{Kinematics::parallelogram, 75e-3, 75e-3, 0};
  const std::vector<Place> places = elbows(arm);
  const ShareMap joints = shares(arm, places, {first, second});
  const double c = std::sqrt(3) / 4;
  expect_share(joints, 1 / (1 + c), 1 / (1 + std::cos(pi / 6)));
  EXPECT_NEAR(joints.worst_direction_median, (1 - c) / (1 + c), 0.001);
  EXPECT_NEAR(joints.worst_direction_worst, (1 - 2 * c) / (1 + 2 * c), 0.001);
  // Exact over one half of the area, without any gain over the other.
  for (const Brake& coupled : {difference, sum}) {
    EXPECT_NEAR(shares(arm, places, {first, second, coupled}).worst, 0.536, 0.003);
    EXPECT_GE(shares(arm, places, {first, second, coupled}).median, 0.98);
  }
  expect_share(shares(arm, places, {first, second, difference, sum}), 1, 1);
  expect_share(shares(arm, places, {difference, sum}), 1, 1);
}

// 63/75 mm, motors 25 mm apart, on 80 × 40 mm placed 70 to 110 mm out, which it reaches.
TEST(BrakeShare, FiveBar) {
  const std::vector<Place> places = places_in(five_bar_arm, inner_desk, 120);
  ASSERT_EQ(places.size(), 14400u);
  expect_share(shares(five_bar_arm, places, {first, second}), 0.836, 0.652);
  expect_share(shares(five_bar_arm, places, {first, second, difference}), 1, 0.732);
  expect_share(shares(five_bar_arm, places, {first, second, sum}), 0.867, 0.652);
  expect_share(shares(five_bar_arm, places, {first, second, difference, sum}), 1, 1);
}

// The same on 100 × 60 mm, of which it leaves 1.8 % unreached at two corners: the least share is that at the edge of
// what it reaches.
TEST(BrakeShare, FiveBarToTheEdgeOfItsReach) {
  const std::vector<Place> places = places_in(five_bar_arm, desk, 100);
  EXPECT_NEAR(double(places.size()), 9823, 10);
  EXPECT_NEAR(shares(five_bar_arm, places, {first, second}).median, 0.7815, 0.003);
  EXPECT_NEAR(shares(five_bar_arm, places, {first, second, difference}).median, 0.943, 0.003);
  EXPECT_NEAR(shares(five_bar_arm, places, {first, second, sum}).median, 1, 0.003);
}

// 70/90 mm, coaxial motors, on 100 × 60 mm placed 70 to 130 mm out.
TEST(BrakeShare, CoaxialFiveBar) {
  const std::vector<Place> places = places_in(coaxial_arm, desk, 100);
  expect_share(shares(coaxial_arm, places, {first, second}), 0.874, 0.617);
  expect_share(shares(coaxial_arm, places, {first, second, difference}), 0.8905, 0.617);
  expect_share(shares(coaxial_arm, places, {first, second, sum}), 1, 0.853);
  expect_share(shares(coaxial_arm, places, {difference, sum}), 1, 1);
}

// Where the least share is, is told.
TEST(BrakeShare, TellsWhereItIsLeast) {
  const Arm arm{Kinematics::parallelogram, 75e-3, 75e-3, 0};
  const ShareMap map = shares(arm, elbows(arm), {first, second});
  const double reach = std::hypot(map.worst_at[0], map.worst_at[1]);
  // At 30° or at 150°, which err alike.
  const double apart =
      std::min(std::abs(reach - 150e-3 * std::cos(pi / 12)), std::abs(reach - 150e-3 * std::sin(pi / 12)));
  EXPECT_LT(apart, 0.1e-3);
}

// The default is delay-proof everywhere, and its brakes turn 1/(1 − c²) of what is wanted into heat.
TEST(BrakeShare, DiagonalIsDelayProofEverywhere) {
  for (const Place& place : places_in(serial_arm, inner_desk, 20)) {
    const Share share = share_at(serial_arm, place.joints, {first, second}, BrakeRule::diagonal, alike_everywhere);
    EXPECT_TRUE(share.delay_proof);
    const Symmetric<double> target = at_joints(pose(serial_arm, place.joints), Symmetric<double>{5, 0, 5});
    EXPECT_NEAR(share.alike, 1 / (1 - target.xy * target.xy / (target.xx * target.yy)), 1e-10 * share.alike);
  }
}

}  // namespace
}  // namespace dashpot::testing
