// The runtime's arm is the compiler's: a law is bound and certified for the one and runs on the other.
#include <gtest/gtest.h>

#include <dashpot/arm_kinematics.hpp>

#include <cmath>
#include <random>

#include "axes/kinematics.hpp"

namespace dashpot::compiler::axes::arms {
namespace {

struct Kind {
  Kinematics of_compiler;
  arm_kind of_runtime;
};

constexpr Kind kinds[] = {{Kinematics::serial, arm_kind::serial},
                          {Kinematics::parallelogram, arm_kind::parallelogram},
                          {Kinematics::five_bar, arm_kind::five_bar},
                          {Kinematics::cartesian, arm_kind::cartesian}};

// Where a five-bar closes with room to spare, and so does any other.
Pair<double> draw_joints(std::mt19937& draw) {
  std::uniform_real_distribution<double> off(-0.3, 0.3);
  return {2.2 + off(draw), 0.95 + off(draw)};
}

TEST(ArmKinematics, PutsTheTipWhereTheCompilerDoesAndMovesItSo) {
  std::mt19937 draw(1);
  for (const Kind& kind : kinds) {
    const Arm arm{kind.of_compiler, 0.063, 0.075, 0.025};
    const arm_geometry geometry{kind.of_runtime, 0.063, 0.075, 0.025, {}, {}};
    for (int i = 0; i < 100; ++i) {
      const Pair<double> q = draw_joints(draw);
      const double joints[2] = {q[0], q[1]}, rest[2] = {};
      const Pose<double> expected = pose(arm, q);
      const arm_point tip = pose_of(geometry, joints, rest).tip;
      for (unsigned axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(tip.position[axis], expected.tip[axis], 1e-15);
        for (unsigned j = 0; j < 2; ++j) EXPECT_NEAR(tip.jacobian[axis][j], expected.column[j][axis], 1e-14);
      }
    }
  }
}

// J̇ q̇ against the Jacobian a little later and a little earlier on the way: differences are good to h² = 1e-8 of it.
TEST(ArmKinematics, TurnsItsJacobianAsItMoves) {
  std::mt19937 draw(2);
  const double v[2] = {1.5, -0.8}, h = 1e-4;
  for (const Kind& kind : kinds) {
    const Arm arm{kind.of_compiler, 0.063, 0.075, 0.025};
    const arm_geometry geometry{kind.of_runtime, 0.063, 0.075, 0.025, {}, {}};
    for (int i = 0; i < 20; ++i) {
      const Pair<double> q = draw_joints(draw);
      const double joints[2] = {q[0], q[1]};
      const arm_point tip = pose_of(geometry, joints, v).tip;
      const Pair<double> on{h * v[0], h * v[1]};
      const Pair<Pair<double>> after = pose(arm, q + on).column, before = pose(arm, q - on).column;
      for (unsigned axis = 0; axis < 2; ++axis) {
        double turned = 0;
        for (unsigned j = 0; j < 2; ++j) turned += (after[j][axis] - before[j][axis]) / (2 * h) * v[j];
        EXPECT_NEAR(tip.centripetal[axis], turned, 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace dashpot::compiler::axes::arms
