// Random networks behind a contact, without slips and with coupled ones: forces and surface against element-by-element
// minimisation, energy and unilaterality at every step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "slips/element_reference.hpp"
#include "support/random.hpp"
#include "support/shrink.hpp"
#include "touched.hpp"

namespace dashpot::testing {
namespace {

constexpr std::size_t samples = 200;

// The motion of a network, half of it out of the tissue.
std::vector<double> touching_motion(const compiler::Network& network, std::uint64_t seed, double at) {
  std::vector<double> motion = random_motion(network, seed, samples);
  for (double& position : motion) position += at;
  return motion;
}

std::string disagreement(const compiler::Network& free_network) {
  const compiler::Network network = behind_contact(free_network, 0.25);
  const compiler::Compilation compilation = compiled(network, compiler::Scheme::backward_euler);
  TouchedForce law(compilation);
  ElementReference reference(network, slip_period);
  double scale = 0, trial = 0, farthest = 0.25;
  for (double position : touching_motion(network, 7, 0.25)) {
    trial = std::max(trial, stiffest(network) * std::abs(position - 0.25 - reference.surface()));
    farthest = std::max({farthest, std::abs(position), std::abs(reference.surface())});
    const double expected = reference.step(position), actual = law.step(position);
    scale = std::max(scale, std::abs(expected));
    // As for slips; and every sample rounds where the surface is, which the stiffest element answers.
    if (!(std::abs(actual - expected) <=
          1e-10 * scale + 0x1p-48 * trial + samples * 0x1p-53 * farthest * stiffest(network)))
      return fmt::format("force {} for {} at a scale of {}", actual, expected, scale);
  }
  return "";
}

// V_k − V_{k−1} ≤ f_k Δu_k through touch, release and re-contact; f ≥ 0; the surface never behind the tool.
std::string breach(const compiler::Network& free_network, compiler::Scheme scheme) {
  const compiler::Network network = behind_contact(free_network, 0);
  const compiler::Compilation compilation = compiled(network, scheme);
  TouchedForce law(compilation);
  double stored = 0, last = 0, scale = 0, largest = 0;
  for (double position : touching_motion(network, 11, 0)) {
    const double force = law.step(position), work = force * (position - last), now = law.stored_energy();
    scale = std::max({scale, std::abs(work), now, stiffest(network) * position * position * 1e-3});
    largest = std::max({largest, std::abs(force), 1e-3 * stiffest(network) * std::abs(position)});
    if (!(now - stored - work <= 1e-13 * scale))
      return fmt::format("energy rose by {} for {} at a scale of {}", now - stored, work, scale);
    if (!(force >= -1e-13 * largest)) return fmt::format("pulls with {} at a scale of {}", force, largest);
    if (!(law.gap(position) >= 0)) return fmt::format("tool {} behind the surface", -law.gap(position));
    stored = now;
    last = position;
  }
  return "";
}

NetworkRecipe recipe(std::size_t most_slips, Topology topology = Topology::tree) {
  NetworkRecipe recipe;
  recipe.topology = topology;
  recipe.most_nodes = 9;
  recipe.most_slips = most_slips;
  return recipe;
}

}  // namespace

// If this failed, the law without slips would open or close the gap at the wrong time, or put the surface in the wrong
// place.
TEST(ContactAgreement, LinearLawMatchesElementSimulation) {
  EXPECT_EQ(first_failure(1, repetitions(72, 20000), recipe(0), disagreement), "");
}

// The same behind slips, where the whole curve must be known to find its zero.
TEST(ContactAgreement, SlipsMatchElementSimulation) {
  EXPECT_EQ(first_failure(1, repetitions(72, 20000), recipe(6), disagreement), "");
}

// The same where the slips meet outside a tree: the contact is one of them.
TEST(ContactAgreement, NonTreeSlipsMatchElementSimulation) {
  EXPECT_EQ(first_failure(1, repetitions(72, 20000), recipe(5, Topology::graph), disagreement), "");
}

// If this failed, a tissue would give energy away when it is left or touched again, or hold on to the tool.
TEST(ContactEnergy, NeverRisesByMoreThanTheWork) {
  for (const compiler::Scheme scheme : {compiler::Scheme::exact, compiler::Scheme::backward_euler})
    for (const NetworkRecipe& shape : {recipe(0), recipe(6), recipe(5, Topology::graph)})
      EXPECT_EQ(first_failure(1, repetitions(72, 20000), shape,
                              [=](const compiler::Network& network) { return breach(network, scheme); }),
                "");
}

// If this failed, the motions above would hardly ever leave the tissue, and the tests prove nothing about it.
TEST(ContactAgreement, CoversTouchAndRelease) {
  std::size_t touches = 0, releases = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const compiler::Compilation compilation =
        compiled(behind_contact(random_network(seed, recipe(6)), 0), compiler::Scheme::exact);
    TouchedForce law(compilation);
    bool was_free = true;
    for (double position : touching_motion(compilation.network, 11, 0)) {
      law.step(position);
      const bool is_free = law.gap(position) > 0;
      if (was_free != is_free) ++(is_free ? releases : touches);
      was_free = is_free;
    }
  }
  EXPECT_GT(touches, 200u);
  EXPECT_GT(releases, 200u);
}

}  // namespace dashpot::testing
