// Which part the brakes take: closed forms by hand, and against an independent solver.
#include <gtest/gtest.h>

#include "arms.hpp"
#include "barrier_solver.hpp"

namespace dashpot::testing {
namespace {

using Target = Symmetric<double>;

const std::vector<Brake> joint_brakes{{{1, 0}}, {{0, 1}}};
const std::vector<Brake> with_difference{{{1, 0}}, {{0, 1}}, {{1, -1}}};

Target random_positive(Random& random) {
  const double p = random.log_uniform(0.1, 10), s = random.log_uniform(0.1, 10), c = random.uniform(-0.999, 0.999);
  return {p, c * std::sqrt(p * s), s};
}

std::vector<Brake> random_brakes(Random& random, std::size_t count, bool limited) {
  std::vector<Brake> brakes;
  const double first = random.uniform(0, pi);
  for (std::size_t j = 0; j < count; ++j) {
    const double angle = first + pi * (double(j) + random.uniform(0.05, 0.95)) / double(count);
    const double length = random.log_uniform(0.3, 3);
    const double most = limited && random.chance(0.6) ? random.log_uniform(0.02, 5) : unlimited;
    brakes.push_back({{length * std::cos(angle), length * std::sin(angle)}, most});
  }
  return brakes;
}

double taken(const std::vector<Brake>& brakes, const std::vector<double>& d, const Target& motion) {
  double sum = 0;
  for (std::size_t j = 0; j < d.size(); ++j) sum += d[j] * form(brakes[j].along, motion, brakes[j].along);
  return sum;
}

void expect_allowed(const std::vector<Brake>& brakes, const std::vector<double>& d, const Target& target) {
  for (std::size_t j = 0; j < d.size(); ++j) {
    EXPECT_GE(d[j], 0);
    EXPECT_LE(d[j], brakes[j].most);
  }
  EXPECT_GE(least_eigenvalue(target - made_by(brakes, d)), -1e-12 * (target.xx + target.yy));
}

// The brakes never put in more than is wanted, and no split that an independent solver finds takes more: one to four
// brakes, with limits and without.
TEST(NonInjecting, IsNeverBeaten) {
  Random random(20);
  for (int i = 0; i < 1000; ++i) {
    const std::vector<Brake> brakes = random_brakes(random, random.between(1, 4), random.chance(0.5));
    const Target target = random_positive(random), motion = random_positive(random);
    const std::vector<double> d = non_injecting(brakes, target, motion);
    expect_allowed(brakes, d, target);
    const BarrierSplit other = BarrierSolver(brakes, target, motion).solve();
    const double ours = taken(brakes, d, motion), theirs = taken(brakes, other.dampings, motion);
    EXPECT_GE(ours, theirs * (1 - 1e-12)) << i;
    // And the solver comes as near as it promises, so that it would have seen something better.
    EXPECT_LE(ours, theirs + other.gap + 1e-6 * theirs) << i;
  }
}

// An isotropic field: d = (1 − |c|)(p, s), with c the cosine between the columns of J.
TEST(NonInjecting, IsotropicFieldHasItsClosedForm) {
  Random random(21);
  for (int i = 0; i < 100; ++i) {
    const Pose<double> at = pose(five_bar_arm, *joints_at(five_bar_arm, random_tip(random)));
    const Target target = at_joints(at, Target{5, 0, 5});
    const double c = std::abs(target.xy) / std::sqrt(target.xx * target.yy);
    const std::vector<double> d = non_injecting(joint_brakes, target, isotropic_motion(at.column));
    EXPECT_NEAR(d[0], (1 - c) * target.xx, 1e-12 * target.xx);
    EXPECT_NEAR(d[1], (1 - c) * target.yy, 1e-12 * target.yy);
  }
}

// By hand: [[2, −1], [−1, 3]] = diag(1, 2) + (1, −1)(1, −1)ᵀ, and no brake on the difference helps where r > 0.
TEST(NonInjecting, ThreeBrakesSplitExactlyWhereTheyCan) {
  const Target alike{1, 0, 1};
  EXPECT_EQ(non_injecting(with_difference, {2, -1, 3}, alike), (std::vector<double>{1, 2, 1}));
  const std::vector<double> d = non_injecting(with_difference, {2, 1, 3}, alike);
  EXPECT_EQ(d[2], 0);
  EXPECT_EQ(d[0], non_injecting(joint_brakes, {2, 1, 3}, alike)[0]);
  EXPECT_EQ(diagonal<double>(with_difference, {2, -1, 3}), (std::vector<double>{1, 2, 1}));
}

// Sums and differences of equal links give every isotropic field exactly, everywhere.
TEST(NonInjecting, PolarArmsNeedTwoBrakesOnly) {
  const std::vector<Brake> polar{{{1, 1}}, {{1, -1}}};
  const Arm equal{Kinematics::parallelogram, 70e-3, 70e-3, 0};
  Random random(22);
  for (const Arm& arm : {equal, coaxial_arm}) {
    for (int i = 0; i < 50; ++i) {
      const Pose<double> at = pose(arm, *joints_at(arm, random_tip(random)));
      const Target target = at_joints(at, Target{5, 0, 5});
      const Target rest = target - made_by(polar, non_injecting(polar, target, isotropic_motion(at.column)));
      EXPECT_LT(std::abs(rest.xx) + std::abs(rest.xy) + std::abs(rest.yy), 1e-13 * (target.xx + target.yy));
    }
  }
}

// A damper along one direction gets nothing from brakes along others: any d > 0 would resist where nothing is wanted.
TEST(NonInjecting, SingleDirectionNeedsABrakeAlongIt) {
  const Target alike{1, 0, 1}, slanted = outer(Pair<double>{0.6, 0.8});
  for (const double d : non_injecting(with_difference, slanted, alike)) EXPECT_NEAR(d, 0, 1e-12);
  EXPECT_NEAR(non_injecting(with_difference, outer(Pair<double>{1, -1}), alike)[2], 1, 1e-12);
  EXPECT_NEAR(diagonal<double>(joint_brakes, slanted)[0], 0.36, 1e-15);
  EXPECT_NEAR(diagonal<double>(joint_brakes, slanted)[1], 0.64, 1e-15);
}

// Nothing to couple, nothing wanted at all: no division by zero on the way.
TEST(NonInjecting, UncoupledOrZeroFieldsNeedNoDivision) {
  const Target alike{1, 0, 1};
  EXPECT_EQ(non_injecting(joint_brakes, {2, 0, 3}, alike), (std::vector<double>{2, 3}));
  EXPECT_EQ(non_injecting(joint_brakes, {0, 0, 3}, alike), (std::vector<double>{0, 3}));
  EXPECT_EQ(non_injecting(joint_brakes, {0, 0, 0}, alike), (std::vector<double>{0, 0}));
  EXPECT_EQ(non_injecting({{{1, 0}, 0.5}, {{0, 1}, 0.25}}, {2, 0, 3}, alike), (std::vector<double>{0.5, 0.25}));
}

// Two brakes on one shaft do what one of both limits would.
TEST(NonInjecting, BrakesOnOneShaftAddUp) {
  const std::vector<Brake> twins{{{1, 0}, 0.5}, {{0, 1}}, {{2, 0}, 0.25}};
  const std::vector<double> d = non_injecting<double>(twins, {2, 0, 3}, {1, 0, 1});
  EXPECT_NEAR(d[0] + 4 * d[2], 1.5, 1e-12);
  EXPECT_NEAR(d[1], 3, 1e-12);
  const std::vector<double> diagonals = diagonal<double>(twins, {2, 0.3, 3});
  EXPECT_NEAR(diagonals[0] + 4 * diagonals[2], 1.5, 1e-12);
  const std::vector<Brake> same{{{1, 0}, 0.5}, {{1, 0}, 0.7}};
  EXPECT_NEAR(non_injecting<double>(same, {2, 0, 3}, {1, 0, 1})[1], 0.7, 1e-12);
  EXPECT_NEAR(diagonal<double>(same, {2, 0, 3})[1], 0.7, 1e-12);
}

// 2 diag B* ≥ B* for two axes, in the coordinates of any two brakes, and so with brakes between them; never with a
// limit that takes half. Non-injecting is delay-proof for isotropic fields where |c| ≤ 1/3 only.
TEST(DelayProof, DiagonalAlwaysIsWithoutLimits) {
  Random random(23);
  for (int i = 0; i < 1000; ++i) {
    const std::vector<Brake> brakes = random_brakes(random, random.between(2, 4), false);
    const Target target = random_positive(random);
    const std::vector<double> d = diagonal(brakes, target);
    EXPECT_TRUE(is_delay_proof(made_by(brakes, d), target)) << i;
    // What is left is no more than what is wanted, either way: −D ≤ R ≤ D.
    EXPECT_GE(least_eigenvalue(made_by(brakes, d)), 0);
  }
  EXPECT_FALSE(is_delay_proof(made_by<double>(joint_brakes, {0.9, 1}), {2, 0, 2}));
  const auto split = [](double c) {
    return is_delay_proof(made_by(joint_brakes, non_injecting<double>(joint_brakes, {1, c, 1}, {1, -c, 1})), {1, c, 1});
  };
  EXPECT_TRUE(split(0.333) && split(-0.333));
  EXPECT_FALSE(split(0.334) || split(-0.334));
}

// Half-viscosity is about the frequency response: with D ≥ ½B* the Hermitian part of D + (B* − D) G is positive for
// every |G| ≤ 1, and for some G it is not with 0.9 of such a D that is only just enough.
TEST(DelayProof, IsWhatEveryDelayDemands) {
  Random random(24);
  // Of D + (B* − D) Re G, both real and symmetric, the Hermitian part is least at Re G = ±1.
  const auto worst = [](const Target& d, const Target& wanted) {
    return std::min(least_eigenvalue(wanted), least_eigenvalue(2.0 * d - wanted));
  };
  for (int i = 0; i < 1000; ++i) {
    const Target wanted = random_positive(random), d = random_positive(random);
    const Target enough = (0.5 * eigenvalues(wanted, d)[1]) * d;
    EXPECT_TRUE(is_delay_proof((1 + 1e-9) * enough, wanted));
    EXPECT_GE(worst(enough, wanted), -1e-12);
    EXPECT_FALSE(is_delay_proof(0.9 * enough, wanted));
    EXPECT_LT(worst(0.9 * enough, wanted), 0);
  }
}

}  // namespace
}  // namespace dashpot::testing
