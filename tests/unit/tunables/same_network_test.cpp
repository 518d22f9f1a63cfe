// A law with tunables at its default values against the law of the same network without any, which is made in another way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/shrink.hpp"
#include "tunable_run.hpp"

namespace dashpot::testing {
namespace {

constexpr double period = 1e-3;  // [s]

std::string without_tunables(std::string text) {
  for (std::size_t at; (at = text.find(", \"tunable\": true")) != text.npos;) text.erase(at, text.find('}', at) - at);
  return text;
}

// The largest difference of the whole force, relative to its largest value.
double difference(const std::string& text, std::uint64_t seed, compiler::Scheme scheme) {
  compiler::Choices choices;
  choices.scheme = scheme;
  choices.state_input = compiler::StateInput::position;
  choices.decomposition = "velocity-free";
  const TunableLaw tunable(text, choices), plain(without_tunables(text), choices);
  compiler::Evaluation<double> here(tunable.law()), there(plain.law());
  Random random(seed);
  double last = 0, scale = 0, worst = 0;
  for (double position : random_walk(random, 300)) {
    const double velocity = (position - last) / period;
    const command<double> a = here.step(position, velocity), b = there.step(position, velocity);
    const double of_a = a.damping * velocity + a.force, of_b = b.damping * velocity + b.force;
    scale = std::max({scale, std::abs(of_b), std::abs(b.damping * velocity), std::abs(b.force)});
    // At the very place of a surface rounding decides whether it is touched, and with that about b v̂.
    const bool either = (a.damping == 0) != (b.damping == 0) && std::abs(a.force - b.force) <= 1e-12 * scale;
    worst = std::max(worst, either ? 0 : std::abs(of_a - of_b));
    last = position;
  }
  return scale > 0 ? worst / scale : worst;
}

// Modes lose digits where rates differ by decades, element states where they add up elongations: 300 samples' roundings at
// values over five decades.
constexpr double rounding = 1e-9;

void expect_same_forces(Kind kind, compiler::Scheme scheme) {
  for (std::uint64_t seed = 1; seed <= repetitions(100, 5000); ++seed) {
    const std::string text = tunable_network(seed, kind);
    ASSERT_LE(difference(text, seed, scheme), rounding) << "seed " << seed << ", " << text;
  }
}

// A network would change its forces by having a slider.
TEST(SameNetwork, of_branches_in_the_exact_scheme) { expect_same_forces(Kind::parallel_branches, compiler::Scheme::exact); }
TEST(SameNetwork, of_branches_in_backward_euler) { expect_same_forces(Kind::parallel_branches, compiler::Scheme::backward_euler); }
TEST(SameNetwork, of_trees_in_backward_euler) { expect_same_forces(Kind::tree, compiler::Scheme::backward_euler); }
TEST(SameNetwork, of_graphs_in_backward_euler) { expect_same_forces(Kind::graph, compiler::Scheme::backward_euler); }
TEST(SameNetwork, of_slips_in_backward_euler) { expect_same_forces(Kind::slips, compiler::Scheme::backward_euler); }
TEST(SameNetwork, behind_a_contact_in_the_exact_scheme) { expect_same_forces(Kind::touched, compiler::Scheme::exact); }
TEST(SameNetwork, behind_a_contact_in_backward_euler) { expect_same_forces(Kind::touched, compiler::Scheme::backward_euler); }
TEST(SameNetwork, of_slips_behind_a_contact_in_backward_euler) { expect_same_forces(Kind::touched_slips, compiler::Scheme::backward_euler); }

}  // namespace
}  // namespace dashpot::testing
