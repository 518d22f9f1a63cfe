// Joints of a workspace, and where an arm is singular in it.
#include <gtest/gtest.h>

#include "arms.hpp"
#include "axes/curvature.hpp"

namespace dashpot::testing {
namespace {

const Arm short_arm{Kinematics::five_bar, 80e-3, 60e-3, 60e-3};

// There and back, on the branch that is stated.
TEST(Workspace, JointsPutTheTipThere) {
  Random random(6);
  for (const Arm& arm : every_arm) {
    for (int i = 0; i < 300; ++i) {
      const Pair<double> tip = random_tip(random), q = *joints_at(arm, tip);
      const Pair<double> back = pose(arm, q).tip;
      EXPECT_NEAR(back[0], tip[0], 1e-15);
      EXPECT_NEAR(back[1], tip[1], 1e-15);
      if (arm.kind == Kinematics::serial) {
        EXPECT_TRUE(0 < q[1] && q[1] < pi);
      }
      if (arm.kind == Kinematics::parallelogram) {
        EXPECT_TRUE(q[0] < q[1] && q[1] < q[0] + pi);
      }
    }
  }
}

// What is proved over a box of joints is only then proved of a part of the workspace.
TEST(Workspace, PartsAreEnclosed) {
  Random random(7);
  for (const Arm& arm : every_arm) {
    for (int i = 0; i < 300; ++i) {
      const Box part = random_part(random, 0.2);
      const std::optional<Box> joints = joints_over(arm, part);
      ASSERT_TRUE(joints);
      const Pair<double> q = *joints_at(arm, random_tip(random, part));
      EXPECT_TRUE(widened((*joints)[0], 1e-14).holds(q[0]) && widened((*joints)[1], 1e-14).holds(q[1]));
    }
  }
}

TEST(Workspace, RegularArmsAreFoundRegular) {
  for (const Arm& arm : every_arm) EXPECT_FALSE(singularity(arm, inner_desk)) << int(arm.kind);
  EXPECT_FALSE(singularity(coaxial_arm, desk));
}

// Links of 63 and 75 mm reach 138 mm, and no nearer than 12 mm.
TEST(Workspace, SingularArmsAreFoundWithThePlace) {
  const Box wide{Interval(-0.1, 0.1), Interval(0.05, 0.13)};
  const auto far = singularity(serial_arm, wide);
  ASSERT_TRUE(far);
  EXPECT_GT(std::hypot(far->tip[0], far->tip[1]), 138e-3 * (1 - 1e-2));
  const Box close{Interval(-0.02, 0.02), Interval(0.005, 0.05)};
  const auto near = singularity(parallelogram_arm, close);
  ASSERT_TRUE(near);
  EXPECT_LT(std::hypot(near->tip[0], near->tip[1]), 13e-3);
  // Right through the circle of full reach, between tips that are reached and tips that are not.
  const Box edge{Interval(-1e-3, 1e-3), Interval(137.5e-3, 138.5e-3)};
  EXPECT_TRUE(singularity(serial_arm, edge));
  // Motor axes 60 mm apart, links of 80 and 60 mm: distal links are in line 60 mm to either side of a tip that is
  // √(80² − 30²) = 74.2 mm out.
  const auto folded = singularity(short_arm, {Interval(-1e-3, 1e-3), Interval(70e-3, 80e-3)});
  ASSERT_TRUE(folded);
  EXPECT_NEAR(folded->tip[1], 74.2e-3, 2e-3);  // 1.2 mm from there J is a hundred times as large as usual
}

TEST(Workspace, KindsOfSingularitiesAreTold) {
  const auto kind = [](const Arm& arm, double from, double to) {
    return singularity(arm, {Interval(-1e-3, 1e-3), Interval(from, to)}).value().kind;
  };
  EXPECT_EQ(kind(serial_arm, 140e-3, 150e-3), Singularity::Kind::out_of_reach);
  EXPECT_EQ(kind(serial_arm, 5e-3, 8e-3), Singularity::Kind::too_close);
  EXPECT_EQ(kind(short_arm, 60e-3, 65e-3), Singularity::Kind::too_close);  // below the line of the elbows
  EXPECT_EQ(kind(short_arm, 74.5e-3, 80e-3), Singularity::Kind::in_line);
}

// A workspace to the left of the motors, where directions jump from π to −π, has ranges without a jump.
TEST(Workspace, RangesHaveNoJump) {
  const Box left{Interval(-110e-3, -70e-3), Interval(-20e-3, 20e-3)};
  const Box ranges = joint_ranges(parallelogram_arm, left);
  EXPECT_LT(ranges[0].width(), 2);
  EXPECT_LT(ranges[1].width(), 2);
  EXPECT_GT(ranges[0].width(), 0.5);
}

// The farthest joints of a workspace, by hand: of a cartesian device its sides, of a coaxial arm those of corners.
TEST(Workspace, RangesAreThoseOfTheFarthestTips) {
  const Box sides = joint_ranges(Arm{}, desk);
  EXPECT_EQ(sides[0].low, -50e-3);
  EXPECT_EQ(sides[1].high, 130e-3);
  const Box ranges = joint_ranges(coaxial_arm, desk);
  EXPECT_NEAR(ranges[0].high, (*joints_at(coaxial_arm, {-50e-3, 70e-3}))[0], 0.02);
  EXPECT_NEAR(ranges[1].low, (*joints_at(coaxial_arm, {50e-3, 70e-3}))[1], 0.02);
}

// Areas add up to the workspace's.
TEST(Workspace, PlacesCoverTheArea) {
  double area = 0;
  for (const Place& place : places_in(serial_arm, inner_desk, 20)) area += place.area;
  EXPECT_NEAR(area, 80e-3 * 40e-3, 1e-12);
}

}  // namespace
}  // namespace dashpot::testing
