// Linear parts seen at several nodes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "linear/multiport_form.hpp"
#include "support/random.hpp"
#include "support/shrink.hpp"

namespace dashpot::testing {
namespace {

using compiler::NodeIndex;
using compiler::Real;

// Every terminal moves as the tool does, or not at all.
struct Held {
  std::vector<NodeIndex> terminals;
  std::vector<bool> moves;
};

Held random_terminals(const compiler::Network& network, Random& random) {
  Held held;
  for (NodeIndex node = 2; node < network.nodes.size(); ++node) {
    if (held.terminals.size() == 4 || !random.chance(0.4)) continue;
    held.terminals.push_back(node);
    held.moves.push_back(random.chance(0.5));
  }
  held.terminals.push_back(compiler::tool);
  held.moves.push_back(true);
  return held;
}

// The same as a one-port: terminals are one with tool or ground.
compiler::Network joined(compiler::Network network, const Held& held) {
  for (std::size_t i = 0; i < held.terminals.size(); ++i)
    for (compiler::Element& element : network.elements)
      for (NodeIndex* node : {&element.a, &element.b})
        if (*node == held.terminals[i]) *node = held.moves[i] ? compiler::tool : compiler::ground;
  std::erase_if(network.elements, [](const compiler::Element& element) { return element.a == element.b; });
  return network;
}

// xᵀ D(jω) x for x of ones and zeros.
compiler::ComplexReal stiffness_of(const compiler::MultiportForm& form, const Held& held, const Real& w) {
  compiler::ComplexReal sum{0, 0};
  const auto apart = [&](const compiler::Tie& tie) {
    const bool moves_b = tie.b < held.moves.size() && held.moves[tie.b];
    return held.moves[tie.a] != moves_b;
  };
  for (const compiler::Tie& tie : form.springs)
    if (apart(tie)) sum.real += tie.value;
  for (const compiler::Tie& tie : form.dampers)
    if (apart(tie)) sum.imaginary += tie.value * w;
  for (const compiler::MultiportMode& mode : form.modes) {
    Real drive = 0;
    for (std::size_t i = 0; i < held.moves.size(); ++i)
      if (held.moves[i]) drive += mode.weights[i];
    const Real share = mode.stiffness * drive * drive * w / (w * w + mode.relaxation_rate * mode.relaxation_rate);
    sum.real += share * w;
    sum.imaginary += share * mode.relaxation_rate;
  }
  return sum;
}

std::string difference(const compiler::Network& network, std::uint64_t seed) {
  Random random(seed);
  const Held held = random_terminals(network, random);
  std::vector<std::size_t> elements;
  for (std::size_t i = 0; i < network.elements.size(); ++i) elements.push_back(i);
  const compiler::MultiportForm form = compiler::multiport_form(network, elements, held.terminals);
  compiler::Network one_port = joined(network, held);
  const bool carries = tidy(one_port);
  const compiler::LinearForm expected = carries ? compiler::linear_form(one_port) : compiler::LinearForm{};
  for (const char* rate : {"1e-6", "0.01", "1", "37", "1e5"}) {
    const Real w(rate);
    const compiler::ComplexReal here = stiffness_of(form, held, w), there = compiler::dynamic_stiffness(expected, w);
    const Real scale = abs(there.real) + abs(there.imaginary);
    // Values spread over eight decades, each sum loses some of 50 digits.
    if (abs(here.real - there.real) + abs(here.imaginary - there.imaginary) > Real("1e-25") * scale)
      return fmt::format("at {}: {} + {}j for {} + {}j", rate, compiler::to_double(here.real),
                         compiler::to_double(here.imaginary), compiler::to_double(there.real),
                         compiler::to_double(there.imaginary));
  }
  return "";
}

}  // namespace

// If this failed, slips outside trees would be joined by another linear part than the author's: with every terminal
// held or moving along it is a one-port.
TEST(Multiport, MatchesOnePortsWithTerminalsHeldOrMoving) {
  NetworkRecipe recipe;
  recipe.topology = Topology::graph;
  recipe.most_nodes = 12;
  for (std::uint64_t choice = 1; choice <= 3; ++choice)
    EXPECT_EQ(first_failure(1, repetitions(120, 5000), recipe,
                            [=](const compiler::Network& network) { return difference(network, choice); }),
              "");
}

}  // namespace dashpot::testing
