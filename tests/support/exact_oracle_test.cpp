#include "support/exact_oracle.hpp"

#include <gtest/gtest.h>

namespace {

using namespace dashpot::testing;
namespace compiler = dashpot::compiler;
using compiler::ground;
using compiler::tool;

const Exact rounding{"1e-55"};

compiler::Network network(std::size_t nodes, std::vector<compiler::Element> elements) {
  compiler::Network network;
  network.nodes.resize(nodes);
  network.elements = std::move(elements);
  return network;
}

compiler::Element spring(double stiffness, compiler::NodeIndex a, compiler::NodeIndex b) {
  return {"", compiler::Spring{stiffness}, a, b, {}, {}};
}

compiler::Element damper(double damping, compiler::NodeIndex a, compiler::NodeIndex b) {
  return {"", compiler::Damper{damping}, a, b, {}, {}};
}

// Fails if a Maxwell element is not K jωB/(K + jωB).
TEST(ExactOracle, KnowsTheMaxwellElement) {
  const auto maxwell = network(3, {spring(3, tool, 2), damper(5, 2, ground)});
  const ExactComplex d = dynamic_stiffness_by_elimination(maxwell, Exact(2));
  EXPECT_LT(abs(d.real - Exact(300) / 109), rounding);
  EXPECT_LT(abs(d.imaginary - Exact(90) / 109), rounding);
}

// Fails if a bridge in balance is not that of its two branches, or if its cross arm counts.
TEST(ExactOracle, KnowsTheBalancedBridge) {
  const auto bridge = network(
      4, {spring(2, tool, 2), spring(4, tool, 3), spring(6, 2, ground), spring(12, 3, ground), damper(7, 2, 3)});
  const ExactComplex d = dynamic_stiffness_by_elimination(bridge, Exact(10));
  EXPECT_LT(abs(d.real - Exact("4.5")), rounding);
  EXPECT_LT(abs(d.imaginary), rounding);
}

// Fails if elements that carry no force change the answer.
TEST(ExactOracle, LeavesOutWhatHasNoEffect) {
  auto loose = network(3, {spring(2, tool, ground), damper(7, tool, 2)});
  loose.elements[1].has_effect = false;
  const ExactComplex d = dynamic_stiffness_by_elimination(loose, Exact(10));
  EXPECT_LT(abs(d.real - 2), rounding);
  EXPECT_LT(abs(d.imaginary), rounding);
}

}  // namespace
