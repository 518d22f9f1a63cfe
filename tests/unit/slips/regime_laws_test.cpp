// The brake's command as slips hold and give way: the three laws of theory, section 5.
#include <dashpot/brake_coil.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "commanded.hpp"
#include "decompose/slip_laws.hpp"
#include "element_reference.hpp"
#include "slip_run.hpp"
#include "support/random.hpp"
#include "support/shrink.hpp"
#include "support/written_network.hpp"

namespace dashpot::testing {
namespace {

using compiler::SlipLaw;

struct FigureTen {
  double stiffness = 300;  // K [N/m]
  double yield = 1;        // Y [N]
  double at_tool = 2;      // B1 [N·s/m]
  double beside_slip = 3;  // B2 [N·s/m]

  compiler::Network network() const {
    return written_network(
        fmt::format("{{\"parallel\": [{{\"damper\": {}}}, {{\"series\": [{{\"spring\": {}}}, {{\"parallel\": "
                    "[{{\"slip\": {}}}, {{\"damper\": {}}}]}}]}}]}}",
                    at_tool, stiffness, yield, beside_slip));
  }
};

const char* const kelvin_and_slip = R"({"series": [{"parallel": [{"spring": 500}, {"damper": 5}]}, {"slip": 0.4}]})";

}  // namespace

// Fails if what hangs behind a slip is braked while it slides, or the motor then pushes along the motion.
TEST(RegimeLaws, KelvinInSeriesWithASlidingSlipIsNotBraked) {
  const auto commands =
      commands_along(decided(written_network(kelvin_and_slip), "most-dissipative").law, slide(0.2, 100));
  // Stuck, the Kelvin element would carry 5·0.2 + 500 u > 0.4 at once, so that every sample slides.
  for (const command<double>& now : commands) {
    EXPECT_EQ(now.damping, 0);
    EXPECT_EQ(now.force, 0.4);
  }
  const auto slow = commands_along(decided(written_network(kelvin_and_slip), "most-dissipative").law, slide(0.02, 30));
  for (std::size_t i = 0; i < 29; ++i) {
    EXPECT_EQ(slow[i].damping, 5) << i;
    EXPECT_NEAR(slow[i].force, 500 * 0.02 * slip_period * double(i + 1), 1e-15) << i;
  }
  for (const auto& now : slow) EXPECT_GE(now.force, 0);
}

// Fails if the default takes a law that a run shows to err by more than it may, one with less brake than another that
// serves, or does not say why.
TEST(RegimeLaws, TheDefaultTakesTheLargestBrakeThatServes) {
  compiler::Device device = device_with(0);
  device.description.velocity.estimator = estimator_kind::butterworth;
  device.description.velocity.cutoff = 100;
  for (const compiler::Device* on :
       {static_cast<const compiler::Device*>(nullptr), static_cast<const compiler::Device*>(&device)})
    for (const double stiffness : {300.0, 3e5}) {
      const compiler::SlipDecomposition slips =
          decided(FigureTen{.stiffness = stiffness}.network(), "most-dissipative", on).decomposition.slips;
      const compiler::ComponentSplit& split = slips.components.front();
      ASSERT_FALSE(slips.merits.empty());
      const auto chosen = std::find_if(slips.merits.begin(), slips.merits.end(),
                                       [&](const auto& merit) { return merit.law == split.law; });
      ASSERT_NE(chosen, slips.merits.end());
      EXPECT_LE(chosen->error(), slips.limit);
      for (const compiler::SlipLawMerit& merit : slips.merits)
        if (merit.error() <= slips.limit && on == nullptr) {
          EXPECT_GE(chosen->mean_damping, merit.mean_damping * (1 - 1e-9)) << name_of(merit.law);
        }
      EXPECT_NE(split.reason.find("the largest mean damping of the brake"), std::string::npos) << split.reason;
    }
  const auto offers =
      decided(FigureTen{}.network(), "velocity-free", &device).decomposition.slips.components.front().offers;
  EXPECT_NE(offers[2].refusal.find("'butterworth' has an infinite impulse response"), std::string::npos)
      << offers[2].refusal;
}

// (21) with the sign of the sliding force: B1 ∥ (K — slip) ∥ [B2 while sliding].
TEST(RegimeLaws, GatedIsEquationTwentyOne) {
  const FigureTen model;
  const compiler::Network network = model.network();
  const auto motion = random_motion(network, 3, 500);
  const auto commands = commands_along(decided(network, "gated").law, motion);
  const double reach = model.yield / model.stiffness;  // δ_max
  double x = 0, scale = 0;
  for (double u : motion) scale = std::max(scale, std::abs(u));
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double u = motion[i];
    const bool slides = std::abs(u - x) > reach * (1 + 1e-9);
    if (std::abs(std::abs(u - x) - reach) < 1e-9 * reach) continue;  // either
    if (slides) x = u - std::copysign(reach, u - x);
    EXPECT_EQ(commands[i].damping, model.at_tool + (slides ? model.beside_slip : 0)) << i;
    EXPECT_NEAR(commands[i].force, model.stiffness * (u - x), 0x1p-44 * model.stiffness * scale) << i;
  }
}

// Fails if (21) is not the limit of the network for a stiff spring: at the same K δ_max the error of the force in a
// slide that changes its speed falls as B2/K.
TEST(RegimeLaws, EquationTwentyOneIsTheStiffLimit) {
  double last = 0;
  for (double stiffness : {1e4, 2e4, 4e4}) {
    const FigureTen model{.stiffness = stiffness, .beside_slip = 0.5};
    std::vector<double> motion;
    for (int i = 1; i <= 4000; ++i) motion.push_back(0.05 * i * slip_period + 0.01 * std::sin(2 * i * slip_period));
    const auto truth = commands_along(decided(model.network(), "velocity-free").law, motion);
    const auto printed = commands_along(decided(model.network(), "gated").law, motion);
    double worst = 0;
    for (std::size_t i = 1000; i < motion.size(); ++i) {
      const double velocity = (motion[i] - motion[i - 1]) / slip_period;
      worst = std::max(
          worst, std::abs((truth[i].damping - printed[i].damping) * velocity + truth[i].force - printed[i].force));
    }
    if (last > 0) {
      EXPECT_NEAR(worst / last, 0.5, 0.02);
    }
    last = worst;
  }
}

// Fails if a slow slide over a quantised encoder makes the brake toggle, or a reversal more than once there and back.
TEST(RegimeLaws, SlowSlidesOverAnEncoderDoNotToggle) {
  const double step = 30e-6, speed = 0.01;
  const compiler::Device device = device_with(step), blind = device_with(0);
  const std::vector<double> motion = there_and_back(speed, step);
  for (const char* law : {"gated", "ramped"}) {
    const auto calm = commands_along(decided(FigureTen{}.network(), law, &device).law, motion);
    EXPECT_EQ(toggles(calm, 1000, 2000), 0u) << law;
    if (law == std::string("gated")) {
      EXPECT_LE(toggles(calm, 2000, 3999), 2u);
    }
    EXPECT_EQ(toggles(calm, 3000, 3999), 0u) << law;
  }
  const auto calm = commands_along(decided(FigureTen{}.network(), "gated", &device).law, motion);
  const auto literal = commands_along(decided(FigureTen{}.network(), "gated", &blind).law, motion);
  EXPECT_GT(toggles(literal, 1000, 2000), 300u);
  for (std::size_t i = 0; i < motion.size(); ++i)
    EXPECT_EQ(calm[i].force, literal[i].force) << "the hysteresis is of the command only";
}

// Fails if the estimate's memory, the coil or the tolerance is not allowed for in what the motor takes back of the
// brake.
TEST(RegimeLaws, CompensationNeverMakesEnergy) {
  const SlowBrake slow;
  const compiler::Network network = FigureTen{.at_tool = 0.01}.network();
  for (const auto& [name, law] : {std::pair("ramped", SlipLaw::ramped), std::pair("steady", SlipLaw::steady)}) {
    const compiler::Compilation c = decided(network, name, &slow.device);
    ASSERT_EQ(c.decomposition.slips.components.front().law, law);
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      std::vector<double> motion = slide(0.1, 1500);  // up the ramp
      for (double u : adversarial_motion(seed)) motion.push_back(0.15 + u);
      EXPECT_GE(slow.least_balance(c.law, motion, std::sqrt(c.law.damping)), -1e-12) << name << seed;
    }
  }
}

// The test above would prove nothing if compensation that allows for none of them could not make energy.
TEST(RegimeLaws, CompensationThatIsNotHeldMakesEnergy) {
  const SlowBrake slow;
  const compiler::UpdateLaw law = bold(decided(FigureTen{.at_tool = 0.01}.network(), "ramped"));
  double least = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed)
    least = std::min(least, slow.least_balance(law, adversarial_motion(seed)));
  EXPECT_LT(least, -0.01);
}

// Fails if compensation is withheld for ever: in a long slide the whole force is that of the network, but for the
// tolerance and the share that a ramp leaves.
TEST(RegimeLaws, LongSlidesAreCompensated) {
  SlowBrake slow;
  slow.device.description.brake.tolerance = 0;
  const FigureTen model;
  for (const char* law : {"ramped", "steady"}) {
    const auto commands = commands_along(decided(model.network(), law, &slow.device).law, slide(0.1, 3000));
    EXPECT_NEAR(commands.back().damping * 0.1 + commands.back().force,
                model.yield + 0.1 * (model.at_tool + model.beside_slip),
                compiler::ramp_error * 0.1 * model.beside_slip + 1e-9);
    EXPECT_NEAR(commands.back().damping, model.at_tool + model.beside_slip, 1e-12);
  }
}

// Fails if a ramp's brake, or what the motor takes back of it, ever changes by more than the ramp says.
TEST(RegimeLaws, ARampHasNoClicks) {
  const SlowBrake slow;
  const FigureTen model;
  const compiler::Compilation c = decided(model.network(), "ramped", &slow.device);
  const double most = 2 * c.decomposition.slips.ramp * model.beside_slip;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto commands = commands_along(c.law, adversarial_motion(seed));
    for (std::size_t i = 1; i < commands.size(); ++i)
      ASSERT_LE(std::abs(commands[i].damping - commands[i - 1].damping), most * (1 + 1e-9));
  }
}

// Fails if the command asks more of the coil than it can do in a period, led as far as its current goes.
TEST(RegimeLaws, TheCoilCanFollow) {
  const SlowBrake slow;
  const FigureTen model;
  for (const char* law : {"gated", "ramped"})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      brake_coil<double> coil(slow.device.description.brake);
      coil.reset(std::sqrt(model.at_tool));
      for (const auto& now :
           commands_along(decided(model.network(), law, &slow.device).law, adversarial_motion(seed))) {
        const double wanted = std::sqrt(now.damping), demand = coil.demand_to_reach(wanted, slip_period);
        ASSERT_GE(demand, -1e-12);
        ASSERT_LE(demand, std::sqrt(model.at_tool + model.beside_slip) + 1e-12);
        coil.advance(demand, slip_period);
        ASSERT_NEAR(coil.root_damping(), wanted, 1e-12);
      }
    }
}

// Fails if the motor does not make up for a coil on its way, where the damper at the tool covers it, or makes energy of
// it where it does not.
TEST(RegimeLaws, TheMotorMakesUpForTheCoil) {
  const SlowBrake slow;
  const FigureTen covered{.at_tool = 5};
  const auto limited = commands_along(decided(covered.network(), "gated", &slow.device).law, adversarial_motion(1));
  const auto direct = commands_along(decided(covered.network(), "gated").law, adversarial_motion(1));
  const auto motion = adversarial_motion(1);
  std::size_t differ = 0;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double velocity = (motion[i] - (i == 0 ? 0 : motion[i - 1])) / slip_period;
    EXPECT_NEAR(limited[i].damping * velocity + limited[i].force, direct[i].damping * velocity + direct[i].force,
                1e-12 * (1 + 10 * std::abs(velocity)));
    differ += limited[i].damping != direct[i].damping;
  }
  EXPECT_GT(differ, 50u);
  for (const char* law : {"gated", "ramped"}) {
    const compiler::Compilation led = decided(FigureTen{.at_tool = 1}.network(), law, &slow.device);
    for (std::uint64_t seed = 1; seed <= 100; ++seed)
      EXPECT_GE(slow.least_balance(led.law, adversarial_motion(seed), std::sqrt(1.0)), -1e-12) << law << seed;
  }
}

namespace {

NetworkRecipe few_slips() {
  NetworkRecipe recipe;
  recipe.most_nodes = 8;
  recipe.most_slips = 3;
  return recipe;
}

// With `law` and a brake of little reach.
std::string gain_with_a_small_brake(const compiler::Network& network, const char* law) {
  if (!has_slips(network)) return "";
  compiler::Device device = device_with(1e-5);
  device.description.brake.max_damping = 0.1;
  device.description.velocity.estimator = estimator_kind::butterworth;  // so that nothing is compensated
  device.description.velocity.cutoff = 100;
  compiler::Choices choices;
  choices.decomposition = law;
  choices.state_input = compiler::StateInput::position;
  if (!can_have(network, law)) return "";
  // What the brake takes is taken from a whole that is rounded.
  const auto taken = [](double damping, double change) { return damping * change / slip_period * change; };
  return energy_from_motor(compiled(network, choices, &device), random_motion(network, 11, 200), 0.1, taken, 0);
}

// Capped, the law of the whole is still that of the elements.
std::string departure_when_capped(const compiler::Network& network) {
  if (!has_slips(network)) return "";
  compiler::Device device = device_with(0);
  device.description.brake.max_damping = 0.1;
  compiler::Choices choices;
  choices.decomposition = "velocity-free";
  choices.scheme = compiler::Scheme::backward_euler;
  const compiler::Compilation compilation = compiled(network, choices, &device);
  WholeForce law(compilation.law);
  ElementReference reference(network, slip_period);
  double scale = 0, last = 0, trial = 0;
  for (double position : random_motion(network, 7, 200)) {
    const double expected = reference.step(position), actual = law.step(position);
    scale = std::max(scale, std::abs(expected));
    for (const compiler::Element& element : network.elements) {
      if (const auto* spring = std::get_if<compiler::Spring>(&element.law))
        trial = std::max(trial, spring->stiffness * std::abs(position - last));
      if (const auto* damper = std::get_if<compiler::Damper>(&element.law))
        trial = std::max(trial, damper->damping / slip_period * std::abs(position - last));
    }
    last = position;
    if (!(std::abs(actual - expected) <= 1e-10 * scale + 0x1p-48 * trial))
      return fmt::format("force {} for {} at a scale of {}", actual, expected, scale);
  }
  return "";
}

std::string first_gain(const char* law) {
  return first_failure(1, repetitions(72, 20000), few_slips(),
                       [=](const compiler::Network& network) { return gain_with_a_small_brake(network, law); });
}

}  // namespace

// Fails if the motor alone, under any switching of the brake, could give more than it took.
TEST(SwitchingTheorem, VelocityFree) { EXPECT_EQ(first_gain("velocity-free"), ""); }

// Fails likewise for the law that leaves the dampers beside the slips to the brake.
TEST(SwitchingTheorem, Gated) { EXPECT_EQ(first_gain("gated"), ""); }

// Fails if a brake that cannot give all makes another network of it.
TEST(SwitchingTheorem, CappedLawsAreExact) {
  EXPECT_EQ(first_failure(1, repetitions(72, 20000), few_slips(), departure_when_capped), "");
}

}  // namespace dashpot::testing
