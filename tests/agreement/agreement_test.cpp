// `dashpot simulate` and the emitted code are the same law: they agree in every bit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "batch.hpp"
#include "support/random.hpp"
#include "support/random_network.hpp"
#include "support/shrink.hpp"

namespace dashpot::testing {
namespace {

using compiler::ground;
using compiler::Network;
using compiler::tool;

// Maxwell branches enough for rolled loops, and for the last round of a loop to be of any length. Every other time all
// relax slowly, so that their guards take turns.
Network many_branches(std::uint64_t seed, std::size_t count) {
  Random random(seed);
  const bool is_slow = seed % 100 == 0;
  Network network;
  network.name = fmt::format("random_{}", seed);
  network.nodes = {"ground", "tool"};
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t inner = network.nodes.size();
    network.nodes.push_back(fmt::format("n{}", i));
    network.elements.push_back(
        {fmt::format("K{}", i), compiler::Spring{random.log_uniform(1e-2, is_slow ? 10 : 1e4)}, tool, inner, {}, {}});
    network.elements.push_back(
        {fmt::format("B{}", i), compiler::Damper{random.log_uniform(is_slow ? 1 : 1e-4, 1e2)}, inner, ground, {}, {}});
  }
  return network;
}

// Small trees and graphs mostly, larger ones now and then, and rolled ones.
Network network_of(std::uint64_t seed) {
  if (seed % 50 == 0) return many_branches(seed, 15 + seed / 50);
  NetworkRecipe recipe;
  recipe.topology = seed % 2 == 0 ? Topology::tree : Topology::graph;
  recipe.most_nodes = seed % 10 == 0 ? 24 : 8;
  return random_network(seed, recipe);
}

Choice choice_of(std::uint64_t seed) {
  static const std::vector<Choice> choices = all_choices();
  return choices[seed % choices.size()];
}

// What is wrong with a network alone, for the search of the smallest.
std::string complaint_about(const Network& network, const Choice& choice, const std::string& scalar) {
  const TemporaryFolder folder;
  return complaints_about({{network, choice}}, scalar, folder.path()).front();
}

// The complaint about the first case that has one, with its seed and the smallest network that has it too.
std::string first_disagreement(const std::string& scalar) {
  const std::size_t count = repetitions(250, 10000);
  std::vector<Case> cases;
  for (std::uint64_t seed = 1; seed <= count; ++seed) cases.push_back({network_of(seed), choice_of(seed)});
  const TemporaryFolder folder;
  const std::vector<std::string> complaints = complaints_about(cases, scalar, folder.path());
  for (std::size_t i = 0; i < complaints.size(); ++i) {
    if (complaints[i].empty()) continue;
    const auto complain = [&](const Network& network) { return complaint_about(network, cases[i].choice, scalar); };
    return fmt::format("seed {}: {}\n{}", i + 1, complaints[i],
                       json_text(smallest_failing(cases[i].network, complain)));
  }
  return "";
}

// Fails if any column of any row differs in any bit, in double.
TEST(Agreement, OfSimulatedAndEmittedDouble) { EXPECT_EQ(first_disagreement("double"), ""); }

// Fails likewise in float.
TEST(Agreement, OfSimulatedAndEmittedFloat) { EXPECT_EQ(first_disagreement("float"), ""); }

}  // namespace
}  // namespace dashpot::testing
