// The solver of coupled slips by itself, on random trees.
#include <dashpot/slip_tree.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "counted.hpp"
#include "discretise/slip_table.hpp"
#include "support/random.hpp"

namespace dashpot::testing {
namespace {

using compiler::NormalTree;
using Kind = NormalTree::Kind;

NormalTree leaf(Kind kind, double yield = 0) { return {kind, {}, yield, {}, {}}; }

// Everywhere a block; a slip of its own or two parts with slips.
NormalTree random_tree(Kind kind, std::size_t slips, Random& random) {
  NormalTree tree{kind, {}, 0, {}, {leaf(Kind::block)}};
  if (slips == 1 || random.chance(0.5)) {
    tree.children.push_back(leaf(Kind::slip, random.log_uniform(0.1, 10)));
    --slips;
  } else if (slips > 1) {
    const std::size_t part = random.between(1, slips - 1);
    tree.children.push_back(random_tree(kind == Kind::series ? Kind::parallel : Kind::series, part, random));
    slips -= part;
  }
  if (slips > 0)
    tree.children.push_back(random_tree(kind == Kind::series ? Kind::parallel : Kind::series, slips, random));
  return tree;
}

template <class Scalar>
class Steps {
 public:
  Steps(const NormalTree& tree, Random& random) {
    for (std::size_t i = 0; i < compiler::blocks_breadth_first(tree).size(); ++i)
      stiffness.push_back(random.log_uniform(0.1, 1000));
    const compiler::SlipTable table =
        compiler::slip_table(tree, {stiffness.begin(), stiffness.end()}, compiler::ScalarType::float64);
    for (const slip_node<double>& n : table.nodes)
      nodes.push_back({n.kind, n.first_child, n.child_count, n.slips, n.place, n.first_corner, Scalar(n.stiffness),
                       Scalar(n.compliance), Scalar(n.yield)});
    parts.resize(nodes.size());
    corners.resize(static_cast<std::size_t>(slip_tree_corners(nodes.data(), count())));
    merged.resize(static_cast<std::size_t>(slip_curve_room(static_cast<int>(table.slips.size()))));
    held.resize(stiffness.size());
    elongation.resize(stiffness.size());
    sign.resize(table.slips.size());
  }

  int count() const { return static_cast<int>(nodes.size()); }
  Scalar step(double change) {
    slip_tree<Scalar> solver(nodes.data(), count(), parts.data(), corners.data(), merged.data());
    return solver.step(Scalar(change), held.data(), elongation.data(), sign.data());
  }

  std::vector<double> stiffness;
  std::vector<slip_node<Scalar>> nodes;
  std::vector<slip_part_state<Scalar>> parts;
  std::vector<slip_corner<Scalar>> corners, merged;
  std::vector<Scalar> held, elongation;
  std::vector<int> sign;
};

}  // namespace

// If this failed, the banner would promise fewer operations than a step takes, or the work grow faster than with the
// square of the slips.
TEST(SlipTree, TakesNoMoreOperationsThanStated) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const std::size_t slips = random.between(2, 14);
    Steps<Counted> steps(random_tree(Kind::series, slips, random), random);
    const int bound = slip_tree_operations(steps.nodes.data(), steps.count());
    EXPECT_LE(bound, static_cast<int>(20 * slips * (slips + 1) + 80)) << slips << " slips";
    for (int k = 0; k < 5; ++k) {
      for (Counted& force : steps.held) force = random.uniform(-5, 5);
      Counted::operations = 0;
      steps.step(random.chance(0.1) ? 0 : random.uniform(-3, 3));
      ASSERT_LE(Counted::operations, bound) << slips << " slips";
    }
  }
}

// If this failed, slips would give energy, or blocks not add up to what the tool does: work that no block takes is
// theirs to dissipate.
TEST(SlipTree, SlipsOnlyDissipate) {
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    Steps<double> steps(random_tree(Kind::series, random.between(2, 8), random), random);
    for (double& force : steps.held) force = random.uniform(-3, 3);
    const double change = random.uniform(-1, 1) * random.log_uniform(1e-3, 10);
    double left = steps.step(change) * change, scale = std::abs(left);
    for (std::size_t b = 0; b < steps.held.size(); ++b) {
      const double taken = (steps.stiffness[b] * steps.elongation[b] + steps.held[b]) * steps.elongation[b];
      left -= taken;
      scale = std::max(scale, std::abs(taken));
    }
    EXPECT_GE(left, -1e-13 * scale);
  }
}

// If this failed, a finite force would come with a state that is not, and never heal.
TEST(SlipTree, StaysFiniteWhereTheForceIs) {
  Random random(8);
  const double huge = std::numeric_limits<double>::max(), infinite = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 200; ++i) {
    Steps<double> steps(random_tree(Kind::series, random.between(2, 8), random), random);
    for (double change : {huge, -huge, infinite, -infinite, std::nan(""), 0x1p-1074}) {
      const double force = steps.step(change);
      if (!std::isfinite(force)) continue;
      for (double elongation : steps.elongation) EXPECT_TRUE(std::isfinite(elongation)) << change;
    }
  }
}

}  // namespace dashpot::testing
