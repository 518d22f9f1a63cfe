// What the brake takes of slips that are solved together: coupled ones, those outside trees, those behind a contact.
#include <dashpot/brake_coil.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "commanded.hpp"
#include "support/shrink.hpp"
#include "support/written_network.hpp"

namespace dashpot::testing {
namespace {

// Both dampers of `two_slips`, where its second slip gives way.
constexpr double both = 2 * 3 / 5.0;  // [N·s/m]

// No path of series and parallel parts: a bridge of dampers whose middle is a slip.
const char* const damper_bridge = R"([
    {"damper": 2, "nodes": ["tool", "a"]}, {"damper": 3, "nodes": ["tool", "b"]}, {"slip": 0.2, "nodes": ["a", "b"]},
    {"damper": 4, "nodes": ["a", "ground"]}, {"damper": 1, "nodes": ["b", "ground"]}])";

bool takes_part(const compiler::Compilation& c) {
  for (const compiler::ComponentSplit* split : c.decomposition.slips.all())
    for (const compiler::BrakeShare& share : split->shares)
      if (split->regimes.slips.size() > 1 && share.damping > 0) return true;
  return false;
}

std::string gain_without_brake(const compiler::Network& network) {
  return gain_of_coupled(network, "velocity-free", random_motion(network, 11, 200));
}

}  // namespace

// If this failed, the brake would keep the damping of slips that hold, or make another than b∞ = 1/(1/2 + 1/3) when one
// slides.
TEST(CoupledRegimes, FollowTheSlipsThatSlide) {
  const compiler::Compilation c = decided(written_network(two_slips), "velocity-free");
  ASSERT_TRUE(c.law.networks.empty());
  ASSERT_EQ(c.law.couplings.size(), 1u);
  const auto slow = commands_along(c.law, slide(0.1, 400)), fast = commands_along(c.law, slide(0.5, 400));
  // 2·0.1 N at once; 300 u reaches the other 0.2 N after 0.67 mm, which is the seventh sample.
  for (std::size_t i = 0; i < 400; ++i) {
    EXPECT_DOUBLE_EQ(slow[i].damping, i < 6 ? 2 : both) << i;
    EXPECT_DOUBLE_EQ(fast[i].damping, both) << i;
  }
  EXPECT_NEAR(slow[3].force, 300 * 0.1 * slip_period * 4, 1e-14);
  // Sliding for long: 0.4 N and 3 N·s/m at what the second part moves, and 1 N and 2 N·s/m at what the first one does.
  EXPECT_NEAR(fast.back().damping * 0.5 + fast.back().force, 0.4 + 3 * (2 * 0.5 + 1 - 0.4) / 5, 1e-12);
}

// If this failed, a bridge of dampers would be taken for one that its slip always closes, or never.
TEST(CoupledRegimes, FollowSlipsOutsideATree) {
  const compiler::Compilation c = decided(written_network(damper_bridge), "velocity-free");
  ASSERT_EQ(c.law.networks.size(), 1u);
  const auto commands = commands_along(c.law, [] {
    std::vector<double> motion = slide(0.1, 10);
    for (double further : slide(0.5, 10)) motion.push_back(0.1 * slip_period * 10 + further);
    return motion;
  }());
  // At 0.1 m/s the dampers press 0.1 (2·4 − …) on the slip, less than it holds: 5 N·s/m in series with 5.
  const double closed = 2.5, open = 1 / (1 / 2.0 + 1 / 4.0) + 1 / (1 / 3.0 + 1);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_NEAR(commands[i].damping, i < 10 ? closed : open, 1e-14) << i;
}

// If this failed, behind a contact the brake would take nothing of what slips leave it, or keep it when the tool has
// left.
TEST(CoupledRegimes, FollowTheSlipsBehindAContact) {
  compiler::Network network = written_network(two_slips);
  network.contact = compiler::Contact{0, {}};
  const compiler::Compilation c = decided(network, "velocity-free");
  std::vector<double> motion = slide(0.1, 100);
  for (int i = 0; i < 20; ++i) motion.push_back(-1e-3);
  const auto commands = commands_along(c.law, motion);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_DOUBLE_EQ(commands[i].damping, i < 6 ? 2 : both) << i;
  for (std::size_t i = 100; i < 120; ++i) EXPECT_EQ(commands[i].damping, 0) << i;
  for (const command<double>& now : commands) EXPECT_GE(now.force, 0);
}

// If this failed, a component with more slips than regimes are listed for would lose what holds in all of them.
TEST(CoupledRegimes, ManySlipsStillBrakeWithTheCommonDamping) {
  std::string branches = R"({"damper": 2})";
  for (int i = 1; i <= 7; ++i)
    branches += fmt::format(", {{\"series\": [{{\"spring\": {}}}, {{\"slip\": {}}}]}}", 100 * i, 0.1 * i);
  const compiler::Compilation c = decided(written_network("{\"series\": [{\"parallel\": [" + branches +
                                                          R"(]}, {"parallel": [{"slip": 0.4}, {"damper": 3}]}]})"),
                                          "velocity-free");
  EXPECT_TRUE(c.decomposition.slips.components.front().regimes.regimes.empty());
  for (const auto& now : commands_along(c.law, slide(0.2, 50))) EXPECT_DOUBLE_EQ(now.damping, both);
}

// If this failed, a slow slide over a quantised encoder would make the brake toggle.
TEST(CoupledRegimes, DoNotToggleOverAnEncoder) {
  const double step = 30e-6, speed = 0.01;
  const compiler::Device device = device_with(step), blind = device_with(0);
  // Between two counts the tool rests and nothing slides.
  const compiler::Network network = written_network(R"({"series": [
      {"parallel": [{"damper": 2}, {"series": [{"spring": 300}, {"slip": 1}]}]},
      {"parallel": [{"slip": 0.4}, {"series": [{"spring": 10}, {"slip": 2}]}]}]})");
  std::vector<double> motion;
  for (int i = 1; i <= 6000; ++i) {
    const int within = i % 4000;
    const double u = speed * slip_period * (within < 2000 ? within : 4000 - within);
    motion.push_back(std::floor(u / step) * step);
  }
  const auto calm = commands_along(decided(network, "velocity-free", &device).law, motion);
  const auto literal = commands_along(decided(network, "velocity-free", &blind).law, motion);
  EXPECT_EQ(toggles(calm, 1000, 2000), 0u);
  EXPECT_LE(toggles(calm, 2000, 3999), 2u);
  EXPECT_EQ(toggles(calm, 3000, 3999), 0u);
  EXPECT_GT(toggles(literal, 1000, 2000), 300u);
  for (std::size_t i = 0; i < motion.size(); ++i)
    EXPECT_EQ(calm[i].force, literal[i].force) << "the hysteresis is of the command only";
}

// If this failed, a tool held in a tissue whose friction leaves the brake a part would feel it come and go with the
// tremor of the hand: in to 2.3 mm, back to 2 mm, so that friction is well below what it holds.
TEST(CoupledRegimes, HeldBehindAContactNeverToggles) {
  const double step = 30e-6;
  const compiler::Device device = device_with(step);
  compiler::Network network = written_network(R"({"parallel": [{"spring": 500}, {"damper": 5},
      {"series": [{"parallel": [{"spring": 300}, {"damper": 2}]}, {"slip": 0.2}]}]})");
  network.contact = compiler::Contact{0, {}};
  std::vector<double> motion;
  for (int i = 1; i <= 10000; ++i) {
    const double t = i * slip_period, u = (t < 0.05  ? 0.046 * t
                                           : t < 0.1 ? 0.0026 - 0.006 * t
                                                     : 0.002) +
                                          40e-6 * std::sin(2 * std::numbers::pi * 8 * t);
    motion.push_back(std::floor(u / step) * step);
  }
  const auto commands = commands_along(decided(network, "velocity-free", &device).law, motion);
  EXPECT_EQ(toggles(commands, 100, commands.size()), 0u);
  EXPECT_EQ(commands.back().damping, 7);
}

// If this failed, the command would ask more of the coil than it can do in a period.
TEST(CoupledRegimes, TheCoilCanFollow) {
  compiler::Device device = device_with(0);
  device.description.brake.coil_lag = 0.02;
  const compiler::Compilation c = decided(written_network(two_slips), "velocity-free", &device);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    brake_coil<double> coil(device.description.brake);
    coil.reset(std::sqrt(2.0));
    for (const auto& now : commands_along(c.law, adversarial_motion(seed))) {
      const double wanted = std::sqrt(now.damping), demand = coil.demand_to_reach(wanted, slip_period);
      ASSERT_GE(demand, -1e-12);
      ASSERT_LE(demand, std::sqrt(2.0) + 1e-12);
      coil.advance(demand, slip_period);
      ASSERT_NEAR(coil.root_damping(), wanted, 1e-12);
    }
  }
}

// The motor alone, under any switching of the brake, could give more than it took.
TEST(CoupledRegimes, TheMotorAloneMakesNoEnergy) {
  for (const Topology topology : {Topology::tree, Topology::graph})
    EXPECT_EQ(first_failure(1, repetitions(72, 20000), coupled_recipe(topology), gain_without_brake), "");
}

// If this failed, the random networks above would leave nothing to the brake, and the test prove nothing.
TEST(CoupledRegimes, OfRandomNetworksLeaveTheBrakeAPart) {
  std::size_t trees = 0, graphs = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    if (takes_part(compiled(random_network(seed, coupled_recipe(Topology::tree)), compiler::Scheme::exact))) ++trees;
    const compiler::Compilation c =
        compiled(random_network(seed, coupled_recipe(Topology::graph)), compiler::Scheme::exact);
    if (!c.law.networks.empty() && takes_part(c)) ++graphs;
  }
  EXPECT_GE(trees, 40u);
  EXPECT_GE(graphs, 10u);
}

}  // namespace dashpot::testing
