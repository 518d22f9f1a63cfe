// The pencil of stiffness and damping, by the responses that its modes add up to.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "linear/pencil.hpp"
#include "support/random.hpp"
#include "support/repetitions.hpp"

namespace dashpot::testing {
namespace {

using compiler::Pencil;
using compiler::Real;
using compiler::RealMatrix;
using Index = Eigen::Index;

struct Shape {
  const char* name;
  std::function<bool(Index, Index)> are_joined;  // the first node is the later one
};

const Shape shapes[] = {
    {"ladder", [](Index i, Index j) { return i - j == 1; }},
    {"ring", [](Index i, Index j) { return i - j == 2 || i + j == 1; }},
    {"grid", [](Index i, Index j) { return i - j == 4 || (i - j == 1 && i % 4 != 0); }},
    {"binary tree", [](Index i, Index j) { return j == (i - 1) / 2; }},
    {"star", [](Index, Index j) { return j == 0; }},
    {"every pair", [](Index, Index) { return true; }},
    {"three ladders apart", [](Index i, Index j) { return i - j == 3; }},
};

struct Nodes {
  RealMatrix stiffness, damping;
};

void add(RealMatrix& matrix, Index i, Index j, double value) {
  matrix(i, i) += value;
  if (i == j) return;
  matrix(j, j) += value;
  matrix(i, j) -= value;
  matrix(j, i) -= value;
}

// A spring, a damper or both wherever two nodes are joined, and from every node to the ground a damper. Nodes are
// numbered in any order. Where all are alike, many modes are of one rate.
Nodes random_nodes(const Shape& shape, Index size, bool are_alike, Random& random) {
  Nodes nodes{RealMatrix::Zero(size, size), RealMatrix::Zero(size, size)};
  std::vector<Index> number(static_cast<std::size_t>(size));
  std::iota(number.begin(), number.end(), Index{0});
  for (std::size_t i = number.size(); i > 1; --i) std::swap(number[i - 1], number[random.index(i)]);
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j <= i; ++j) {
      if (i != j && !shape.are_joined(i, j)) continue;
      const Index a = number[static_cast<std::size_t>(i)], b = number[static_cast<std::size_t>(j)];
      const bool has_spring = i != j && (are_alike || random.chance(0.7));
      if (has_spring) add(nodes.stiffness, a, b, are_alike ? 100 : random.log_uniform(1, 1e4));
      if (!has_spring || random.chance(0.3)) add(nodes.damping, a, b, are_alike ? 1 : random.log_uniform(0.01, 100));
    }
  return nodes;
}

// Of Dᵀ(K + sB)⁻¹D from the modes, relative to its largest element.
Real error_of_response(const Pencil& pencil, const Nodes& nodes, const RealMatrix& drives, const Real& s) {
  const RealMatrix exact = drives.transpose() * RealMatrix(nodes.stiffness + s * nodes.damping).llt().solve(drives);
  RealMatrix sum = RealMatrix::Zero(drives.cols(), drives.cols());
  for (Index i = 0; i < pencil.mu.size(); ++i)
    sum += pencil.drives.row(i).transpose() * pencil.drives.row(i) /
           (pencil.mu(i) + s / pencil.shift * (1 - pencil.mu(i)));
  return (sum - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

std::string complaint_about(const Nodes& nodes, Random& random) {
  const Index size = nodes.stiffness.rows();
  RealMatrix drives(size, 3);
  for (Index i = 0; i < size; ++i) drives.row(i) << random.uniform(-1, 1), random.uniform(-1, 1), i == 0;
  const Pencil pencil = compiler::solve_pencil(nodes.stiffness, nodes.damping, drives);
  if (!std::is_sorted(pencil.mu.begin(), pencil.mu.end())) return "not ascending";
  if (pencil.mu(0) < -1e-40 || pencil.mu(size - 1) > 1 + 1e-40) return "not between 0 and 1";
  for (const double times : {1e-3, 0.1, 1.0, 10.0, 1e3})
    // 50 digits less those that matrices of 4 decades of values and a ratio of 1e3 lose twice.
    if (const Real error = error_of_response(pencil, nodes, drives, times * pencil.shift); error > 1e-36)
      return fmt::format("the response at {} times the shift is off by {:.2g}", times, error.convert_to<double>());
  return "";
}

// Fails if the modes of nodes joined in any way do not add up to the response of all, whatever the bandwidth is.
TEST(Pencil, AddsUpToTheResponse) {
  Random random(23);
  for (const Shape& shape : shapes)
    for (std::size_t i = 0; i < repetitions(30, 1000); ++i) {
      const auto size = static_cast<Index>(random.between(1, 24));
      const Nodes nodes = random_nodes(shape, size, false, random);
      EXPECT_EQ(complaint_about(nodes, random), "") << shape.name << " of " << size << ", number " << i;
    }
}

// Fails if modes of one rate are lost or counted twice.
TEST(Pencil, KeepsModesOfOneRate) {
  Random random(24);
  for (const Shape& shape : shapes)
    for (const Index size : {2, 3, 9, 16}) {
      const Nodes nodes = random_nodes(shape, size, true, random);
      EXPECT_EQ(complaint_about(nodes, random), "") << shape.name << " of " << size;
    }
}

// Fails if nodes that springs alone hold, or dampers alone, have other than the eigenvalues 1 and 0.
TEST(Pencil, TellsSpringsFromDampers) {
  Random random(25);
  for (const Shape& shape : shapes) {
    const RealMatrix matrix = random_nodes(shape, 12, true, random).damping, none = RealMatrix::Zero(12, 12);
    for (const Real& s : compiler::solve_pencil(matrix, none, none).mu) EXPECT_LT(abs(s - 1), 1e-45);
    for (const Real& s : compiler::solve_pencil(none, matrix, none).mu) EXPECT_LT(abs(s), 1e-45);
  }
}

}  // namespace
}  // namespace dashpot::testing
