#include "support/random_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "compile.hpp"
#include "network/law.hpp"
#include "network/tree.hpp"

namespace {

using namespace dashpot::testing;
namespace compiler = dashpot::compiler;

// Fails if a network that a test prints is not the one that it tried.
TEST(RandomNetwork, ReadsBackAsItWas) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    NetworkRecipe recipe;
    recipe.topology = seed % 2 == 0 ? Topology::tree : Topology::graph;
    recipe.most_slips = seed % 3;
    const compiler::Network written = random_network(seed, recipe);
    const compiler::SourceFile file("random.json", json_text(written));
    compiler::Diagnostics diagnostics;
    const std::optional<compiler::Network> read = compiler::check(file, diagnostics);
    ASSERT_TRUE(read) << json_text(written);
    ASSERT_TRUE(diagnostics.in_file_order().empty()) << json_text(written);
    ASSERT_EQ(compiler::to_text(*read), compiler::to_text(written));
  }
}

// Fails if trees stop being trees, or if graphs are trees all the time.
TEST(RandomNetwork, HasTheTopologyAskedFor) {
  std::size_t bridges = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    ASSERT_TRUE(compiler::series_parallel_tree(random_network(seed, {}))) << seed;
    NetworkRecipe graph;
    graph.topology = Topology::graph;
    bridges += compiler::series_parallel_tree(random_network(seed, graph)) ? 0 : 1;
  }
  EXPECT_GT(bridges, 100u);
}

// Fails if values stay in a narrow band, where no test would meet stiff networks.
TEST(RandomNetwork, SpreadsItsValues) {
  double smallest = 1, largest = 1;
  for (std::uint64_t seed = 0; seed < 50; ++seed)
    for (const compiler::Element& element : random_network(seed, {}).elements) {
      smallest = std::min(smallest, compiler::value_of(element.law));
      largest = std::max(largest, compiler::value_of(element.law));
    }
  EXPECT_GT(largest / smallest, 1e7);
  EXPECT_LE(largest / smallest, 1e8);
}

// Fails if most seeds that ask for slips get none.
TEST(RandomNetwork, HasSlipsWhereAsked) {
  NetworkRecipe recipe;
  recipe.most_nodes = 8;
  recipe.most_slips = 4;
  const auto is_slip = [](const compiler::Element& e) { return std::holds_alternative<compiler::Slip>(e.law); };
  std::size_t with_slips = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const compiler::Network network = random_network(seed, recipe);
    with_slips += std::any_of(network.elements.begin(), network.elements.end(), is_slip) ? 1 : 0;
  }
  EXPECT_GT(with_slips, 120u);
}

}  // namespace
