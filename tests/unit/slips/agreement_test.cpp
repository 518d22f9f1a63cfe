// Laws of random networks with one to six slips, coupled ones included: forces against element-by-element minimisation,
// energy at every step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "element_reference.hpp"
#include "slip_run.hpp"
#include "support/shrink.hpp"

namespace dashpot::testing {
namespace {

constexpr std::size_t samples = 200;

std::size_t slips_in(const compiler::Network& network) {
  return static_cast<std::size_t>(std::count_if(
      network.elements.begin(), network.elements.end(),
      [](const compiler::Element& element) { return std::holds_alternative<compiler::Slip>(element.law); }));
}

bool has_modes(const compiler::NormalTree& tree) {
  return !tree.form.modes.empty() || std::any_of(tree.children.begin(), tree.children.end(), has_modes);
}

// Where every linear part is a spring, a damper or both side by side, the schemes are one. Outside trees that is not
// asked.
bool has_modes(const compiler::NormalForm& form) {
  return !form.networks.empty() || !form.linear.modes.empty() ||
         std::any_of(form.components.begin(), form.components.end(),
                     [](const compiler::NormalTree& tree) { return has_modes(tree); });
}

std::string disagreement(const compiler::Network& network, compiler::Scheme scheme) {
  if (slips_in(network) == 0) return "";
  const compiler::Compilation compilation = compiled(network, scheme);
  if (scheme == compiler::Scheme::exact && has_modes(compilation.form)) return "";
  WholeForce law(compilation.law);
  ElementReference reference(network, slip_period);
  double scale = 0, trial = 0, last = 0;
  for (double position : random_motion(network, 7, samples)) {
    const double expected = reference.step(position), actual = law.step(position);
    scale = std::max(scale, std::abs(expected));
    trial = std::max(trial, stiffest(network) * std::abs(position - last));
    last = position;
    // The closed form subtracts what a slip does not hold from what it would: a few roundoffs of that remain.
    if (!(std::abs(actual - expected) <= 1e-10 * scale + 0x1p-48 * trial))
      return fmt::format("force {} for {} at a scale of {}", actual, expected, scale);
  }
  return "";
}

// V_k − V_{k−1} ≤ m_k Δu_k, the brake's part left out.
std::string gain_of_energy(const compiler::Network& network, compiler::Scheme scheme) {
  if (slips_in(network) == 0) return "";
  const compiler::Compilation compilation = compiled(network, scheme);
  compiler::Evaluation<double> law(compilation.law);
  law.reset(0);
  double stored = 0, last = 0, scale = 0;
  for (double position : random_motion(network, 11, samples)) {
    const double change = position - last;
    const command<double> answer = law.step(position, change / slip_period);
    const double work = answer.force * change, braked = answer.damping * change / slip_period * change,
                 now = law.stored_energy();
    scale =
        std::max({scale, std::abs(work), braked, now});  // what the brake takes is taken from a whole that is rounded
    // Outside a tree ends of stiff elements are rounded, and these answer that.
    if (!(now - stored - work <= 1e-13 * scale + 0x1p-48 * stiffest(network) * change * change))
      return fmt::format("energy rose by {} for {} at a scale of {}", now - stored, work, scale);
    stored = now;
    last = position;
  }
  return "";
}

NetworkRecipe recipe(Topology topology = Topology::tree) {
  NetworkRecipe recipe;
  recipe.topology = topology;
  recipe.most_nodes = 9;
  recipe.most_slips = 6;
  return recipe;
}

std::string first_failure_of(std::string (*complaint)(const compiler::Network&, compiler::Scheme),
                             compiler::Scheme scheme, Topology topology = Topology::tree) {
  return first_failure(1, repetitions(72, 20000), recipe(topology),
                       [=](const compiler::Network& network) { return complaint(network, scheme); });
}

}  // namespace

// If this failed, the solver of coupled slips, its tables, or a closed form would give the forces of another network.
TEST(SlipAgreement, BackwardEulerIsThatOfTheElements) {
  EXPECT_EQ(first_failure_of(disagreement, compiler::Scheme::backward_euler), "");
}

// If this failed, the exact scheme would differ where there is nothing to relax.
TEST(SlipAgreement, ExactIsThatOfTheElementsWithoutModes) {
  EXPECT_EQ(first_failure_of(disagreement, compiler::Scheme::exact), "");
}

// If this failed, a tissue with slips would give energy away.
TEST(SlipEnergy, NeverRisesByMoreThanTheWorkInBackwardEuler) {
  EXPECT_EQ(first_failure_of(gain_of_energy, compiler::Scheme::backward_euler), "");
}

// If this failed, exact modes inside a slip network would break the convexity that backward Euler has by itself.
TEST(SlipEnergy, NeverRisesByMoreThanTheWorkInTheExactScheme) {
  EXPECT_EQ(first_failure_of(gain_of_energy, compiler::Scheme::exact), "");
}

// If this failed, slips outside trees, stars and loops of them included, would have other forces.
TEST(SlipAgreement, GraphsAreThoseOfTheElements) {
  EXPECT_EQ(first_failure_of(disagreement, compiler::Scheme::backward_euler, Topology::graph), "");
}

// If this failed, they would give energy away.
TEST(SlipEnergy, NeverRisesByMoreThanTheWorkInGraphs) {
  for (const compiler::Scheme scheme : {compiler::Scheme::exact, compiler::Scheme::backward_euler})
    EXPECT_EQ(first_failure_of(gain_of_energy, scheme, Topology::graph), "");
}

// If this failed, the graphs above would hardly ever be other than trees, and the tests prove nothing about them.
TEST(SlipAgreement, CoversSlipsOutsideTrees) {
  std::size_t outside = 0, many = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const compiler::Compilation compilation =
        compiled(random_network(seed, recipe(Topology::graph)), compiler::Scheme::exact);
    for (const compiler::SlipNetwork& network : compilation.law.networks) {
      ++outside;
      if (network.slip_count() > 2) ++many;
    }
  }
  EXPECT_GE(outside, 60u);
  EXPECT_GE(many, 20u);
}

// If this failed, the networks above would hardly ever have coupled slips, and the tests prove nothing about them.
TEST(SlipAgreement, CoversCoupledSlips) {
  std::size_t coupled = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed)
    if (most_coupled(compiled(random_network(seed, recipe()), compiler::Scheme::exact)) > 1) ++coupled;
  EXPECT_GE(coupled, 60u);
}

}  // namespace dashpot::testing
