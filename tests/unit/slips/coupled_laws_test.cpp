// The gated and the ramped law of slips that are solved together: coupled ones, those outside trees, those behind
// a contact.
#include <dashpot/brake_coil.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "commanded.hpp"
#include "decompose/slip_laws.hpp"
#include "source/render.hpp"
#include "support/shrink.hpp"
#include "support/written_network.hpp"

namespace dashpot::testing {
namespace {

using compiler::SlipLaw;

// `two_slips` with next to no brake while both hold, so that what is taken back has to be earned.
const char* const loose_slips = R"({"series": [
    {"parallel": [{"damper": 0.01}, {"series": [{"spring": 300}, {"slip": 1}]}]},
    {"parallel": [{"slip": 0.4}, {"damper": 3}]}]})";

// A ring of three slips, of which one has a damper beside it.
const char* const ring = R"([
    {"spring": 300, "nodes": ["tool", "a"]}, {"slip": 0.4, "nodes": ["a", "b"]}, {"damper": 3, "nodes": ["a", "b"]},
    {"slip": 0.3, "nodes": ["b", "c"]}, {"slip": 0.5, "nodes": ["a", "c"]},
    {"spring": 200, "nodes": ["b", "ground"]}, {"damper": 4, "nodes": ["b", "ground"]}, {"spring": 100, "nodes": ["c", "ground"]}])";

compiler::Network touched(compiler::Network network) {
  network.contact = compiler::Contact{0, {}};
  return network;
}

compiler::Network pressed_slips() {
  return touched(written_network(std::string("{\"parallel\": [{\"spring\": 500}, ") + loose_slips + "]}"));
}

compiler::Network pressed_ring() {
  return touched(written_network(
      std::string(ring).insert(std::string(ring).rfind(']'), R"(, {"spring": 500, "nodes": ["tool", "ground"]})")));
}

constexpr std::size_t way_in = 2000;  // [samples]

// Far behind the surface, so that the tool does not leave it, and for so long that all has relaxed.
std::vector<double> deep(std::vector<double> motion) {
  for (double& u : motion) u += 1;
  motion.insert(motion.begin(), way_in, 1);
  return motion;
}

struct Subject {
  const char* name;
  compiler::Network network;
  std::vector<double> (*place)(std::vector<double>);
};

std::vector<double> here(std::vector<double> motion) { return motion; }

std::vector<Subject> subjects() {
  return {{"tree", written_network(loose_slips), here},
          {"ring", written_network(ring), here},
          {"contact", pressed_slips(), deep},
          {"ring behind a contact", pressed_ring(), deep}};
}

std::string gain_of_gated(const compiler::Network& network, bool is_touched) {
  const compiler::Network subject = is_touched ? touched(network) : network;
  if (!can_have(subject, "gated")) return "";
  return gain_of_coupled(subject, "gated", random_motion(network, 11, 200));
}

std::string said_of(const compiler::Network& network, const char* law) {
  compiler::Choices choices;
  choices.decomposition = law;
  compiler::Diagnostics diagnostics;
  const compiler::NormalForm form = compiler::normal_form(network);
  EXPECT_FALSE(
      compiler::decompose(network, form, {network, form, 0}, choices, compiler::PortDevice::ideal(), diagnostics));
  return compiler::render_text(diagnostics);
}

}  // namespace

// If this failed, the motor would render the damper beside a slip that the brake makes already, or the brake not make
// it.
TEST(CoupledLaws, GatedLeavesDampersBesideSlipsToTheBrake) {
  const compiler::Compilation c = decided(written_network(two_slips), "gated");
  ASSERT_EQ(c.decomposition.slips.components.front().law, SlipLaw::gated);
  const auto commands = commands_along(c.law, slide(0.1, 400));
  // 2·0.1 N at once; 300 u reaches the other 0.2 N in the seventh sample. Then 0.4 N, and 3 N·s/m at the whole speed.
  for (std::size_t i = 0; i < 400; ++i) EXPECT_DOUBLE_EQ(commands[i].damping, i < 6 ? 2 : 3) << i;
  for (std::size_t i = 6; i < 400; ++i) EXPECT_NEAR(commands[i].force, 0.4, 1e-15) << i;
}

// If this failed, in a chain of slips without dampers only the weakest would ever give way: the others' dampers would
// be the brake's and never asked for.
TEST(CoupledLaws, GatedTakesTheDamperOfTheWeakestInAChain) {
  const compiler::Network chain = written_network(R"({"series": [{"spring": 1000},
      {"parallel": [{"slip": 0.4}, {"damper": 3}]}, {"parallel": [{"slip": 0.2}, {"damper": 5}]}]})");
  const compiler::Compilation c = decided(chain, "gated");
  const compiler::NormalTree& rendered = c.decomposition.slips.components.front().rendered;
  EXPECT_EQ(compiler::slip_count(rendered), 2u);
  const auto bare = std::find_if(rendered.children.begin(), rendered.children.end(),
                                 [](const auto& child) { return child.kind == compiler::NormalTree::Kind::slip; });
  ASSERT_NE(bare, rendered.children.end());
  EXPECT_EQ(bare->yield_force, 0.2);
  EXPECT_DOUBLE_EQ(commands_along(c.law, slide(0.05, 1000)).back().damping, 5);
}

// If this failed, the motor alone would give more than it took, under whatever brake and coil.
TEST(CoupledLaws, TheMotorOfTheGatedLawMakesNoEnergy) {
  for (const Topology topology : {Topology::tree, Topology::graph})
    EXPECT_EQ(first_failure(1, repetitions(48, 20000), coupled_recipe(topology),
                            [](const auto& network) { return gain_of_gated(network, false); }),
              "");
}

// The same behind a contact.
TEST(CoupledLaws, TheMotorOfTheGatedLawMakesNoEnergyBehindAContact) {
  for (const Topology topology : {Topology::tree, Topology::graph})
    EXPECT_EQ(first_failure(1, repetitions(48, 20000), coupled_recipe(topology),
                            [](const auto& network) { return gain_of_gated(network, true); }),
              "");
}

// If this failed, the random networks above would hardly ever have the law, and the tests prove nothing.
TEST(CoupledLaws, RandomNetworksHaveTheGatedLaw) {
  std::size_t trees = 0, graphs = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const compiler::Network tree = random_network(seed, coupled_recipe(Topology::tree)),
                            graph = random_network(seed, coupled_recipe(Topology::graph));
    if (compiler::normal_form(tree).has_slips() && most_coupled(compiled(tree, compiler::Scheme::exact)) > 1 &&
        can_have(tree, "gated"))
      ++trees;
    if (!compiler::normal_form(graph).networks.empty() && can_have(graph, "gated")) ++graphs;
  }
  EXPECT_GE(trees, 20u);
  EXPECT_GE(graphs, 3u);
}

// If this failed, the memory, the coil or the tolerance would not be allowed for in what the motor takes back of the
// brake.
TEST(CoupledLaws, RampedCompensationNeverMakesEnergy) {
  const SlowBrake slow;
  for (const Subject& subject : subjects()) {
    const compiler::Compilation held = decided(subject.network, "ramped", &slow.device);
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
      const double least = slow.least_balance(held.law, subject.place(adversarial_motion(seed)), 0,
                                              subject.network.contact ? way_in : 0);
      EXPECT_GE(least, -1e-9) << subject.name << " " << seed;
    }
  }
}

// The test above would prove nothing if compensation that is not held could not make energy.
TEST(CoupledLaws, CompensationThatIsNotHeldMakesEnergy) {
  const SlowBrake slow;
  for (const Subject& subject : subjects()) {
    const compiler::UpdateLaw law = bold(decided(subject.network, "ramped"));
    double least = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed)
      least = std::min(least, slow.least_balance(law, subject.place(adversarial_motion(seed)), 0,
                                                 subject.network.contact ? way_in : 0));
    EXPECT_LT(least, -1e-3) << subject.name;
  }
}

// If this failed, compensation would be held for ever: in a long slide the whole force is that of the network.
TEST(CoupledLaws, LongSlidesAreCompensated) {
  SlowBrake slow;
  slow.device.description.brake.tolerance = 0;
  for (const Subject& subject : subjects()) {
    const std::vector<double> motion = subject.place(slide(0.1, 3000));
    const compiler::UpdateLaw law = decided(subject.network, "ramped", &slow.device).law;
    const auto commands = commands_along(law, motion);
    const auto plain = commands_along(decided(subject.network, "velocity-free").law, motion);
    const double felt = commands.back().damping * 0.1 + commands.back().force,
                 expected = plain.back().damping * 0.1 + plain.back().force;
    const double excess = law.largest_damping - law.damping;
    EXPECT_NEAR(felt, expected, compiler::ramp_error * 0.1 * excess + 1e-9 * (1 + expected)) << subject.name;
    EXPECT_GT(commands.back().damping, plain.back().damping) << subject.name;
  }
}

// If this failed, a tool that leaves the tissue and comes back would be pushed by what the brake earned before.
TEST(CoupledLaws, ATouchBeginsAnew) {
  const SlowBrake slow;
  const compiler::Compilation c = decided(pressed_slips(), "ramped", &slow.device);
  std::vector<double> motion = slide(0.1, 3000);
  for (int i = 0; i < 3; ++i) motion.push_back(-1);
  for (double further : slide(0.1, 30)) motion.push_back(0.3 + further);
  compiler::Evaluation<double> quick(c.law), still(c.law);
  quick.reset(0), still.reset(0);
  // What the estimate says changes the motor's part by β alone, b∞ of the linear part being none.
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double difference = still.step(motion[i], 0).force - quick.step(motion[i], 1).force;
    const std::size_t touch = 3003, hold = 5 + 1;
    if (i == 2999) {
      EXPECT_GT(difference, 0.5);
    }
    if (i >= touch && i < touch + hold) {
      EXPECT_EQ(difference, 0) << i;
    }
  }
}

// If this failed, the command would ask more of the coil than it can do in a period.
TEST(CoupledLaws, TheCoilCanFollow) {
  const SlowBrake slow;
  for (const char* law : {"gated", "ramped"})
    for (const Subject& subject : subjects()) {
      if (subject.network.contact) continue;
      const compiler::Compilation c = decided(subject.network, law, &slow.device);
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        brake_coil<double> coil(slow.device.description.brake);
        coil.reset(std::sqrt(compiler::Evaluation<double>(c.law).step(0, 0).damping));
        for (const auto& now : commands_along(c.law, adversarial_motion(seed))) {
          const double wanted = std::sqrt(now.damping), demand = coil.demand_to_reach(wanted, slip_period);
          ASSERT_GE(demand, -1e-12) << subject.name;
          ASSERT_LE(demand, std::sqrt(c.law.largest_damping) + 1e-12) << subject.name;
          coil.advance(demand, slip_period);
          ASSERT_NEAR(coil.root_damping(), wanted, 1e-12) << subject.name;
        }
      }
    }
}

// If this failed, a slow slide over a quantised encoder would make the brake toggle.
TEST(CoupledLaws, DoNotToggleOverAnEncoder) {
  const double step = 30e-6, speed = 0.01;
  const compiler::Device device = device_with(step), blind = device_with(0);
  const std::vector<double> motion = there_and_back(speed, step);
  std::size_t literal = 0;
  for (const char* law : {"gated", "ramped"})
    for (const Subject& subject : subjects()) {
      const std::vector<double> placed = subject.place(motion);
      const std::size_t begin = subject.network.contact ? way_in : 0;
      const auto calm = commands_along(decided(subject.network, law, &device).law, placed);
      EXPECT_EQ(toggles(calm, begin + 1000, begin + 2000), 0u) << law << " " << subject.name;
      // Each slip once, where it holds and where it slides again; a ramp goes there by steps.
      if (law == std::string("gated")) {
        EXPECT_LE(toggles(calm, begin + 2000, begin + 3999), 6u) << subject.name;
      }
      literal = std::max(literal, toggles(commands_along(decided(subject.network, law, &blind).law, placed),
                                          begin + 1000, begin + 2000));
    }
  EXPECT_GT(literal, 300u);
}

// If this failed, a choice that cannot be made would become another in silence.
TEST(CoupledLaws, ImpossibleSlipRulesAreRefused) {
  const compiler::Network bare =
      written_network(R"({"series": [{"parallel": [{"spring": 500}, {"damper": 5}]}, {"slip": 0.4}]})");
  const std::string said = said_of(bare, "gated");
  EXPECT_NE(said.find("--decomposition gated cannot be used for 'slip_3': while slips slide, no damper acts beyond "
                      "those at the tool [no-such-slip-law]"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("'velocity-free' can always be used"), std::string::npos) << said;
  const compiler::Network relaxing = written_network(
      R"({"series": [{"spring": 500}, {"parallel": [{"slip": 0.4}, {"series": [{"spring": 10}, {"damper": 5}]}]}]})");
  EXPECT_NE(said_of(relaxing, "gated").find("no damper is in parallel with a slip"), std::string::npos);
  EXPECT_TRUE(can_have(relaxing, "ramped"));
}

}  // namespace dashpot::testing
