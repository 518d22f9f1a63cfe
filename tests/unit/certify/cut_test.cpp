// Cuts between tool and ground (theory, section 6a, for networks with slips).
#include <gtest/gtest.h>

#include "certify/cut.hpp"
#include "certify/slip_motor.hpp"
#include "motors.hpp"
#include "support/written_network.hpp"

namespace dashpot::compiler {
namespace {

using dashpot::testing::written_network;

const CutSettings settings{Scheme::exact, Real("0.001"), 1};

Cut cut_of(const std::string& network) {
  const Network written = written_network(network);
  const NormalForm form = normal_form(written);
  Cut cut = compiler::cut_of(form.linear, settings);
  for (const NormalTree& component : form.components) cut += least_cut(component, settings).value();
  for (const auto& elements : form.networks) cut += least_cut(written, elements, settings).value();
  return cut;
}

// If this failed, a network that touches the tool through springs only would not need half of their sum, whatever is
// behind them.
TEST(Cut, OfSpringsAtTheTool) {
  const Cut cut = cut_of(R"({ "parallel": [
      { "series": [ { "spring": 300 }, { "parallel": [ { "slip": 2 }, { "damper": 7 } ] } ] },
      { "series": [ { "spring": 500 }, { "parallel": [ { "slip": 1 }, { "series": [ { "spring": 9000 }, { "slip": 3 } ] } ] } ] } ] })");
  EXPECT_EQ(to_double(cut.stiffness), 400);
  EXPECT_EQ(to_double(cut.damping), 0);
}

// If this failed, the softest place of a series would not decide.
TEST(Cut, TakesTheLeastOfASeries) {
  const Cut cut = cut_of(R"({ "series": [ { "spring": 900 }, { "parallel": [ { "slip": 2 }, { "spring": 80 } ] },
                                          { "parallel": [ { "slip": 1 }, { "damper": 0.5 } ] }, { "slip": 4 } ] })");
  EXPECT_EQ(to_double(cut.stiffness), 450);
  const Cut soft = cut_of(
      R"({ "series": [ { "spring": 900 }, { "slip": 4 }, { "parallel": [ { "spring": 80 }, { "series": [ { "spring": 20 }, { "slip": 1 } ] } ] } ] })");
  EXPECT_EQ(to_double(soft.stiffness), 50);
}

// If this failed, the closed form of a Maxwell element, (k/λh) tanh(λh/2), would not be its part of a cut.
TEST(Cut, OfAMaxwellElement) {
  const Cut cut = cut_of(R"({ "series": [ { "spring": 600 }, { "damper": 0.4 }, { "slip": 1 } ] })");
  EXPECT_NEAR(to_double(cut.stiffness), 0.4 / 0.001 * std::tanh(600 / 0.4 * 0.001 / 2), 1e-12);
}

// Outside trees slips could cross a cut: both springs at the tool carry its force, and the one between the slips does
// not.
TEST(Cut, OutsideTreesNoSlipCrosses) {
  const Cut cut = cut_of(R"([ { "nodes": ["tool", "p"], "spring": 100 }, { "nodes": ["tool", "q"], "spring": 60 },
      { "nodes": ["p", "ground"], "slip": 1 }, { "nodes": ["q", "ground"], "slip": 2 }, { "nodes": ["p", "q"], "spring": 1000 } ])");
  EXPECT_NEAR(to_double(cut.stiffness), 80, 1e-12);
}

// If this failed, a late or lagging loop would be granted the bound of a prompt one, or not be given theory's (1 + n)²
// of a hold.
TEST(Lateness, CountsSamplesAndLag) {
  SampledLoop loop = plain_loop(0.001);
  EXPECT_NEAR(lateness(loop), 1, 1e-13);
  loop.delay_samples = 2;
  EXPECT_NEAR(lateness(loop), 3, 1e-13);
  loop.amplifier_lag = 0.1;  // far slower than the loop: its lag in samples
  EXPECT_NEAR(lateness(loop), 103, 0.01);
}

}  // namespace
}  // namespace dashpot::compiler
