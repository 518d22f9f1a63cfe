// What a law behind slips is felt to do: the tolerance rule, on networks and motions that it was not made for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "commanded.hpp"
#include "slip_trial.hpp"
#include "support/random.hpp"
#include "support/written_network.hpp"

namespace dashpot::testing {
namespace {

using compiler::SlipLaw;

// A slip network in which there is something to choose, with values as on a desk.
compiler::Network network_with_choice(std::uint64_t& seed) {
  NetworkRecipe recipe;
  recipe.most_nodes = 7;
  recipe.most_slips = 3;
  recipe.smallest_value = 0.1;
  recipe.largest_value = 100;
  for (;; ++seed) {
    const compiler::Network network = random_network(seed, recipe);
    const auto is_slip = [](const compiler::Element& e) { return std::holds_alternative<compiler::Slip>(e.law); };
    if (std::any_of(network.elements.begin(), network.elements.end(), is_slip) &&
        (can_have(network, "steady") || can_have(network, "gated"))) {
      ++seed;
      return network;
    }
  }
}

compiler::Compilation by_default(const compiler::Network& network, const char* law = "most-dissipative") {
  compiler::Choices choices;
  choices.scheme = compiler::Scheme::backward_euler;
  choices.decomposition = law;
  return compiled(network, choices, nullptr);
}

double largest_departure(const compiler::UpdateLaw& law, const compiler::UpdateLaw& exact,
                         const std::vector<double>& motion, double& peak) {
  WholeForce felt(law), network(exact);
  double worst = 0;
  peak = 0;
  for (const double u : motion) {
    const double truth = network.step(u);
    peak = std::max(peak, std::abs(truth));
    worst = std::max(worst, std::abs(felt.step(u) - truth));
  }
  return worst;
}

}  // namespace

// Fails if the default errs by more than 5 % of the peak in any sample of a run, backward Euler on an ideal device with
// an exact velocity: sines and drags beside those that decided.
TEST(RunError, TheDefaultIsWithinFivePercentAtEverySample) {
  std::uint64_t seed = 1;
  std::size_t braking = 0;
  for (int i = 0; i < 24; ++i) {
    const compiler::Network network = network_with_choice(seed);
    const compiler::Compilation chosen = by_default(network), exact = by_default(network, "virtual");
    const compiler::PortDevice ideal = compiler::PortDevice::ideal();
    const compiler::SlipTrial trial(network, exact.law, exact.law, ideal);
    for (const SlipLaw law : {SlipLaw::steady, SlipLaw::ramped, SlipLaw::gated})
      for (const auto* split : chosen.decomposition.slips.all()) braking += split->law == law ? 1 : 0;
    for (std::size_t m = 0; m < trial.motions().size(); ++m)
      for (const double share : {1.0, 0.7}) {
        std::vector<double> motion = trial.motions()[m].position;
        for (double& u : motion) u *= share;
        double peak = 0;
        const double worst = largest_departure(chosen.law, exact.law, motion, peak);
        EXPECT_LE(worst, 0.05 * peak * (share == 1 ? 1 + 1e-9 : 1.2)) << "seed " << seed - 1 << " motion " << m;
      }
  }
  EXPECT_GE(braking, 6u) << "the default would be velocity-free nearly everywhere";
}

// Fails if the error that is told is not that of the run, or velocity-free is not the network's own force.
TEST(RunError, VelocityFreeHasNone) {
  std::uint64_t seed = 1000;
  for (int i = 0; i < 8; ++i) {
    const compiler::SlipDecomposition slips = by_default(network_with_choice(seed)).decomposition.slips;
    ASSERT_FALSE(slips.merits.empty());
    EXPECT_EQ(slips.merits.front().law, SlipLaw::velocity_free);
    EXPECT_LE(slips.merits.front().error(), 1e-10);
    EXPECT_EQ(slips.limit, 0.05);
  }
}

// Fails if the part of the steady law's excess that is taken is not the largest that keeps to the tolerance.
TEST(RunError, SteadyTakesWhatTheToleranceAllows) {
  const compiler::Device device = [] {
    compiler::Device d = device_with(1e-6);
    d.description.velocity.window = 20;
    d.description.brake.tolerance = 0.1;
    d.description.loop.band_low = 1;
    return d;
  }();
  const compiler::Network network = written_network(
      R"({"parallel": [{"spring": 40}, {"series": [{"spring": 300}, {"parallel": [{"slip": 0.2}, {"damper": 8}]}]}]})");
  const compiler::Compilation c = decided(network, "most-dissipative", &device);
  const compiler::SlipDecomposition& slips = c.decomposition.slips;
  const auto steady = std::find_if(slips.merits.begin(), slips.merits.end(),
                                   [](const auto& merit) { return merit.law == SlipLaw::steady; });
  ASSERT_NE(steady, slips.merits.end());
  EXPECT_LE(steady->error(), slips.limit);
  EXPECT_GT(steady->mean_damping, 0);
}

// Fails if the error between two runs is not that of all samples in between, at its ends included: runs of other noise,
// of the same, and of none.
TEST(RunError, BetweenTwoRunsIsThatOfEverySample) {
  const compiler::Network network = written_network(
      R"({"parallel": [{"damper": 1}, {"series": [{"spring": 500}, {"parallel": [{"slip": 0.4}, {"damper": 5}]}]}]})");
  const compiler::Compilation c = by_default(network, "virtual");
  const compiler::PortDevice ideal = compiler::PortDevice::ideal();
  const compiler::SlipTrial trial(network, c.law, c.law, ideal);
  Random random(7);
  const auto felt_with = [&](double noise, double beyond) {
    std::vector<compiler::FeltForce> felt;
    for (std::size_t m = 0; m < trial.motions().size(); ++m) {
      felt.push_back({trial.network_force(m), trial.network_force(m)});
      for (std::vector<double>* end : {&felt.back().weak, &felt.back().strong})
        for (double& force : *end) force += noise * random.uniform(-1, 1) + beyond;
    }
    return felt;
  };
  const std::pair<double, double> kinds[] = {{0, 0}, {0, 0.2}, {0.3, 0}, {0.3, 0.2}, {2, -0.5}};
  for (const auto& [noise, beyond] : kinds)
    for (const auto& [other_noise, other_beyond] : kinds) {
      const auto first = felt_with(noise, beyond), second = felt_with(other_noise, other_beyond);
      const compiler::ErrorBetween error(trial, first, second);
      for (double share = 0; share <= 1; share += 1.0 / 64) {
        std::vector<compiler::FeltForce> between = first;
        for (std::size_t m = 0; m < between.size(); ++m)
          for (const auto end : {&compiler::FeltForce::weak, &compiler::FeltForce::strong})
            for (std::size_t i = 0; i < (between[m].*end).size(); ++i)
              (between[m].*end)[i] += share * ((second[m].*end)[i] - (first[m].*end)[i]);
        const double expected = trial_error(trial, between).worst();
        EXPECT_NEAR(error.at(share), expected, 1e-12 + 1e-9 * expected) << "at " << share;
      }
    }
}

// Fails if a loop whose rate is far above the band plays a part of a motion only, or works through millions of samples.
TEST(RunError, MotionsOfVeryFastLoopsAreWhole) {
  const compiler::Network network = written_network(
      R"({"parallel": [{"damper": 1}, {"series": [{"spring": 500}, {"parallel": [{"slip": 0.4}, {"damper": 5}]}]}]})");
  compiler::Choices choices;
  choices.rate = 1e9;
  choices.decomposition = "virtual";
  const compiler::Compilation c = compiled(network, choices, nullptr);
  const compiler::PortDevice ideal = compiler::PortDevice::ideal();
  const compiler::SlipTrial trial(network, c.law, c.law, ideal);
  ASSERT_FALSE(trial.motions().empty());
  for (const auto& motion : trial.motions()) {
    EXPECT_LE(motion.position.size(), 1500u) << motion.name;
    const auto [least, most] = std::minmax_element(motion.position.begin(), motion.position.end());
    EXPECT_NEAR(*least, -*most, 0.01 * *most) << motion.name;
  }
}

}  // namespace dashpot::testing
