// Maps of ports: values by hand, derivatives against differences, enclosures, and grids.
#include <gtest/gtest.h>

#include "arms.hpp"
#include "axes/curvature.hpp"
#include "axes/port_map.hpp"

namespace dashpot::testing {
namespace {

using Point = Pair<double>;

double value(const PortMap& map, double x, double y) { return depth(map, Point{x, y}).value; }

// Smooth, without symmetry: what a grid is sampled from.
double hill(double x, double y) { return 1e-3 * std::sin(30 * x) * std::cos(20 * y) + 0.1 * x - 0.05 * y; }

// n knots over 100 mm and one more over 60 mm, so that columns and rows cannot be taken for each other.
Grid hills(std::size_t n) {
  const Point start{-50e-3, 70e-3}, spacing{100e-3 / double(n - 1), 60e-3 / double(n)};
  std::vector<std::vector<double>> values(n + 1, std::vector<double>(n));
  for (std::size_t j = 0; j <= n; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      values[j][i] = hill(start[0] + double(i) * spacing[0], start[1] + double(j) * spacing[1]);
    }
  }
  return grid_map(start, spacing, values);
}

std::vector<PortMap> every_map() {
  return {along({1, 2}),
          wall({0, 80e-3}, {0.3, 1}),
          ball({10e-3, 90e-3}, 20e-3),
          cavity({-5e-3, 60e-3}, 30e-3),
          line({0, 100e-3}, {1, 0.5}, 15e-3),
          hills(9)};
}

// What "positive inside" and "pointing out of the tissue" mean.
TEST(PortMap, DepthsByHand) {
  EXPECT_DOUBLE_EQ(value(along({3, 4}), 5, 10), 11);
  EXPECT_NEAR(value(wall({0, 80e-3}, {0, 2}), 0.3, 75e-3), 5e-3, 1e-16);
  EXPECT_NEAR(value(ball({0, 80e-3}, 20e-3), 9e-3, 92e-3), 5e-3, 1e-16);
  EXPECT_NEAR(value(cavity({0, 80e-3}, 20e-3), 18e-3, 104e-3), 10e-3, 1e-16);
  EXPECT_NEAR(value(line({0, 80e-3}, {5, 0}, 20e-3), 0.3, 95e-3), 5e-3, 1e-16);
}

// At a centre and on a line maps are blunt, not undefined.
TEST(PortMap, CentresHaveNoForceDirection) {
  const Depth<double> centre = depth(PortMap(ball({0, 80e-3}, 20e-3)), Point{0, 80e-3});
  EXPECT_NEAR(centre.value, 20e-3, blunting);
  EXPECT_EQ(std::hypot(centre.gradient[0], centre.gradient[1]), 0);
  EXPECT_EQ(depth(PortMap(line({0, 0}, {1, 0}, 1e-3)), Point{7, 0}).gradient[1], 0);
}

// Power does not leak: the gradient is that of the value, and the Hessian that of the gradient, in the joints of every
// arm.
TEST(PortMap, DerivativesInTheJointsAreThoseOfTheDepth) {
  Random random(8);
  for (const PortMap& map : every_map()) {
    for (const Arm& arm : every_arm) {
      for (int i = 0; i < 20; ++i) {
        const Point q = *joints_at(arm, random_tip(random));
        const auto gradient = [&](const Point& joints) {
          const Pose<double> at = pose(arm, joints);
          return at_joints(at, depth(map, at.tip).gradient);
        };
        const Pose<double> at = pose(arm, q);
        const Symmetric<double> hessian =
            at_joints(at, curvature(arm, q), depth(map, at.tip).gradient, bend(map, at.tip));
        const double step = arm.kind == Kinematics::cartesian ? 1e-7 : 1e-5, scale = 1 / (2 * step);
        for (const std::size_t j : {0u, 1u}) {
          Point ahead = q, behind = q;
          ahead[j] += step, behind[j] -= step;
          const double rise = depth(map, pose(arm, ahead).tip).value - depth(map, pose(arm, behind).tip).value;
          // Truncation, and rounding of 1e-17 m over the step.
          EXPECT_NEAR(scale * rise, gradient(q)[j], 1e-8);
          const Point turn = scale * (gradient(ahead) - gradient(behind));
          // Two cells of a grid meet with the same slope, not with the same bend.
          if (std::holds_alternative<Grid>(map)) continue;
          EXPECT_NEAR(turn[0], j == 0 ? hessian.xx : hessian.xy, 2e-6);
          EXPECT_NEAR(turn[1], j == 0 ? hessian.xy : hessian.yy, 2e-6);
        }
      }
    }
  }
}

TEST(PortMap, BoxesEncloseTheirMembers) {
  Random random(9);
  for (const PortMap& map : every_map()) {
    for (int i = 0; i < 300; ++i) {
      const Box part = random_part(random, random.log_uniform(1e-6, 1), desk);
      const Point x = random_tip(random, part);
      const Depth<double> at = depth(map, x);
      const Depth<Interval> over = depth(map, part);
      const Symmetric<double> bent = bend(map, x);
      const Symmetric<Interval> bends = bend(map, part);
      // What the doubles round off themselves.
      const auto holds = [](const Interval& a, double v) { return widened(a, 1e-13 * (1 + std::abs(v))).holds(v); };
      EXPECT_TRUE(holds(over.value, at.value));
      EXPECT_TRUE(holds(over.gradient[0], at.gradient[0]) && holds(over.gradient[1], at.gradient[1]));
      EXPECT_TRUE(holds(bends.xx, bent.xx) && holds(bends.xy, bent.xy) && holds(bends.yy, bent.yy)) << map.index();
    }
  }
}

// Cubics in x and y are met exactly, slopes and all, from five knots on; beyond the knots the map goes on straight.
TEST(Grid, MeetsCubics) {
  const auto cubic = [](double x, double y) { return x * x * x - 2 * x * y * y + 0.5 * y * y * y + x * y - 3; };
  std::vector<std::vector<double>> values(6, std::vector<double>(5));
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 5; ++i) values[std::size_t(j)][std::size_t(i)] = cubic(i, 2 + 0.5 * j);
  }
  const Grid grid = grid_map({0, 2}, {1, 0.5}, values);
  Random random(10);
  for (int i = 0; i < 200; ++i) {
    const Point x{random.uniform(0, 4), random.uniform(2, 4.5)};
    EXPECT_NEAR(depth(grid, x).value, cubic(x[0], x[1]), 1e-12);
    EXPECT_NEAR(depth(grid, x).gradient[0], 3 * x[0] * x[0] - 2 * x[1] * x[1] + x[1], 1e-11);
    EXPECT_NEAR(depth(grid, x).gradient[1], -4 * x[0] * x[1] + 1.5 * x[1] * x[1] + x[0], 1e-11);
    EXPECT_NEAR(bend(grid, x).xx, 6 * x[0], 1e-10);
    EXPECT_NEAR(bend(grid, x).xy, -4 * x[1] + 1, 1e-10);
    EXPECT_NEAR(bend(grid, x).yy, -4 * x[0] + 3 * x[1], 1e-10);
  }
  const Depth<double> edge = depth(grid, Point{4, 3.2}), out = depth(grid, Point{6, 3.2});
  EXPECT_NEAR(out.value, edge.value + 2 * edge.gradient[0], 1e-12);
  EXPECT_NEAR(out.gradient[0], edge.gradient[0], 1e-12);
  EXPECT_NEAR(bend(grid, Point{6, 5}).xx, 0, 1e-12);
}

// Value and slope pass every side of every cell without a step, also the outermost.
TEST(Grid, IsContinuouslyDifferentiable) {
  const Grid grid = hills(6);
  Random random(11);
  for (std::size_t k = 0; k < 6; ++k) {
    for (int i = 0; i < 20; ++i) {
      const double x = corner(grid, 0, k + 1), y = random.uniform(60e-3, 140e-3);
      const Depth<double> left = depth(grid, Point{x - 1e-13, y}), right = depth(grid, Point{x + 1e-13, y});
      EXPECT_NEAR(left.value, right.value, 1e-13);
      EXPECT_NEAR(left.gradient[0], right.gradient[0], 1e-11);
      EXPECT_NEAR(left.gradient[1], right.gradient[1], 1e-11);
    }
  }
}

double largest_error(const Grid& grid) {
  double worst = 0;
  for (double x = -50e-3; x <= 50e-3; x += 0.7e-3) {
    for (double y = 70e-3; y <= 130e-3; y += 0.7e-3)
      worst = std::max(worst, std::abs(depth(grid, Point{x, y}).value - hill(x, y)));
  }
  return worst;
}

// (hx⁴ A + hy⁴ B)/384 with |∂⁴w/∂x⁴| ≤ A = 1e-3·30⁴, |∂⁴w/∂y⁴| ≤ B = 1e-3·20⁴, once slopes are near enough; and the
// fourth order.
TEST(Grid, ErrsByNoMoreThanIsStated) {
  const auto stated = [](double n) {
    return (std::pow(100e-3 / (n - 1), 4) * 810 + std::pow(60e-3 / n, 4) * 160) / 384;
  };
  EXPECT_LE(largest_error(hills(33)), stated(33));
  EXPECT_LE(largest_error(hills(65)), stated(65));
  EXPECT_NEAR(largest_error(hills(33)) / largest_error(hills(65)), 16, 3);
}

}  // namespace
}  // namespace dashpot::testing
