// What brake and motor do at a contact: over a quantised encoder, with an estimate of the velocity.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <deque>
#include <functional>

#include "touched.hpp"
#include "discretise/discretise.hpp"

namespace dashpot::testing {
namespace {

constexpr double encoder_step = 30e-6;  // [m]
constexpr double damping = 5;           // [N·s/m]
const char* const wall = R"({"parallel": [{"spring": 500}, {"damper": 5}]})";
const char* const tissue =
    R"({"parallel": [{"spring": 300}, {"damper": 5}, {"series": [{"spring": 900}, {"slip": 0.2}]}, {"series": [{"damper": 4}, {"spring": 200}]}]})";

compiler::UpdateLaw law_for(const char* structure, double step, const char* decomposition = "velocity-free") {
  compiler::Compilation c = compiled(behind_contact(structure, 0), compiler::Scheme::exact);
  compiler::Choices choices;
  choices.decomposition = decomposition;
  compiler::Diagnostics diagnostics;
  compiler::Decomposition split = decompose(compiler::linear_part(c.network, c.form), c.form.linear, choices,
                                            compiler::PortDevice::ideal(), diagnostics)
                                      .value();
  split.encoder_step = step;
  return discretise(c.network, c.form, split, choices, 1 / slip_period);
}

// The tool as the law sees it: positions floored to the encoder's step, their slope over 15 samples.
class Sensed {
 public:
  double position(double u) {
    const double y = std::floor(u / encoder_step) * encoder_step;
    past_.push_back(y);
    if (past_.size() > 16) past_.pop_front();
    return y;
  }
  double velocity() const { return (past_.back() - past_.front()) / (15 * slip_period); }

 private:
  std::deque<double> past_ = std::deque<double>(16, 0.0);
};

struct Outcome {
  int toggles = 0;          // of the brake
  int releases = 0;         // of which to 0
  double pull = 0;          // most impulse in a row with which the tool is pulled [N·s]
  double deepest_pull = 0;  // [N]
};

// Commands held over each sample while the tool moves on: 64 instants a sample.
Outcome run(const compiler::UpdateLaw& law, const std::function<double(double)>& motion, double seconds) {
  compiler::Evaluation<double> evaluation(law);
  Sensed sensed;
  Outcome outcome;
  double last_damping = 0, pull = 0;
  evaluation.reset(0);
  for (int k = 1; k * slip_period < seconds; ++k) {
    const double y = sensed.position(motion(k * slip_period));
    const command<double> now = evaluation.step(y, sensed.velocity());
    if (k > 100 && now.damping != last_damping) ++outcome.toggles;
    if (k > 100 && now.damping < last_damping) ++outcome.releases;
    last_damping = now.damping;
    for (int i = 0; i < 64; ++i) {
      const double t = (k + i / 64.0) * slip_period, dt = slip_period / 64;
      const double felt = now.damping * (motion(t + dt) - motion(t)) / dt + now.force;
      pull = felt < 0 ? pull - felt * dt : 0;
      outcome.pull = std::max(outcome.pull, pull);
      outcome.deepest_pull = std::max(outcome.deepest_pull, -felt);
    }
  }
  return outcome;
}

// Down to `depth` within 50 ms, then held with the tremor of a hand.
std::function<double(double)> held(double depth) {
  return [=](double t) { return depth * std::min(t / 0.05, 1.0) + 40e-6 * std::sin(2 * std::numbers::pi * 8 * t); };
}

// In and out again, slowly.
double visits(double t) { return 0.002 * std::sin(2 * std::numbers::pi * 0.4 * t); }

}  // namespace

// If this failed, a tool held in a tissue would feel the brake chatter with the tremor of the hand.
TEST(ContactCommand, HeldTwoMillimetresDeepNeverToggles) {
  for (const char* structure : {wall, tissue}) {
    EXPECT_EQ(run(law_for(structure, encoder_step), held(0.002), 10).toggles, 0) << structure;
  }
}

// If this failed, the hysteresis would be of no use: where a tool barely touches, the gap opens and closes with every
// count.
TEST(ContactCommand, HysteresisKeepsABareTouchQuiet) {
  const int without = run(law_for(wall, 0), held(0.0003), 10).toggles,
            with = run(law_for(wall, encoder_step), held(0.0003), 10).toggles;
  EXPECT_GT(without, 100);
  EXPECT_LT(with, without / 10);
}

// If this failed, the tool would be pulled back as it leaves by more than the brake makes within one step of the
// encoder.
TEST(ContactCommand, PullsNoMoreThanTheStatedHysteresis) {
  for (const char* structure : {wall, tissue}) {
    const Outcome outcome = run(law_for(structure, encoder_step), visits, 20);
    EXPECT_GT(outcome.releases, 5) << structure;
    EXPECT_LE(outcome.pull, damping * encoder_step) << structure;
  }
}

// If this failed, a command that lets go would leave the motor pushing, or one that holds on would take the state with
// it.
TEST(ContactCommand, HysteresisActsOnTheCommandAlone) {
  const compiler::UpdateLaw without = law_for(wall, 0), with = law_for(wall, encoder_step);
  compiler::Evaluation<double> ideal(without), kept(with);
  for (compiler::Evaluation<double>* law : {&ideal, &kept}) law->step(0.002, 2);
  // Back by a count more than the surface follows: the force would be −0.001 N.
  const double free = 0.002 - 0.002 * 500 / (500 + 5000.0), position = free - 1e-7;
  const command<double> at_once = ideal.step(position, -0.1), later = kept.step(position, -0.1);
  EXPECT_EQ(at_once.damping, 0);
  EXPECT_EQ(at_once.force, 0);
  EXPECT_EQ(later.damping, damping);
  EXPECT_NEAR(later.force, 500 * free, 1e-12);
  EXPECT_EQ(ideal.stored_energy(), kept.stored_energy());
  // Where the estimate says that the brake would pull, both let go.
  EXPECT_EQ(kept.step(position - 1e-6, -1).damping, 0);
}

// If this failed, a split that compensates would do so in the sample in which the tool touches or leaves.
TEST(ContactCommand, LeavesNothingToCompensate) {
  const char* const maxwell =
      R"({"parallel": [{"spring": 300}, {"damper": 5}, {"series": [{"damper": 4}, {"spring": 200}]}]})";
  for (const char* name : {"paper", "zero-frequency", "largest-observer"}) {
    const compiler::UpdateLaw law = law_for(maxwell, 0, name);
    EXPECT_EQ(law.largest_damping, damping) << name;
    EXPECT_EQ(law.damping, 0) << name;
    compiler::Evaluation<double> one(law), other(law);
    EXPECT_EQ(one.step(0.001, 1).force, other.step(0.001, 0.5).force) << name;
  }
}

// If this failed, states driven by the estimate would follow the tool where it does not touch the surface.
TEST(ContactCommand, RefusesStatesDrivenByTheEstimate) {
  const compiler::Network network = behind_contact(wall, 0);
  compiler::Choices choices;
  choices.state_input = compiler::StateInput::velocity;
  compiler::Diagnostics diagnostics;
  EXPECT_FALSE(decompose(network, compiler::linear_form(network), compiler::with_names(choices, false),
                         compiler::PortDevice::ideal(), diagnostics));
  EXPECT_EQ(diagnostics.in_file_order().front().code, compiler::DiagnosticCode::contact_needs_position);
}

// If this failed, what explain and the banner say would not be what the command does.
TEST(ContactCommand, TextStatesTheHysteresis) {
  compiler::Compilation c = compiled(behind_contact(wall, 0.002), compiler::Scheme::exact);
  EXPECT_EQ(contact_text(c.decomposition, c.network), "at 0.002 m; brake and motor 0 while the tool is free");
  c.decomposition.encoder_step = encoder_step;
  EXPECT_NE(contact_text(c.decomposition, c.network).find("from a gap of 3e-05 m on"), std::string::npos);
  EXPECT_EQ(contact_text(c.decomposition, written_network(wall)), "");
}

// If this failed, a NaN or infinite sample would change the surface, or find the brake changed.
TEST(ContactCommand, IgnoresNonFiniteSamples) {
  for (const char* structure : {wall, tissue}) {
    const compiler::UpdateLaw law = law_for(structure, encoder_step);
    compiler::Evaluation<double> run(law), untouched(law);
    for (compiler::Evaluation<double>* one : {&run, &untouched}) one->step(0.001, 1);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {std::nan(""), infinity, -infinity})
      for (const auto& [position, velocity] : {std::pair(bad, 0.0), std::pair(0.001, bad), std::pair(bad, bad)}) {
        const command<double> now = run.step(position, velocity);
        EXPECT_EQ(now.force, 0);
        EXPECT_EQ(now.damping, damping);
      }
    const command<double> here = run.step(0.0015, 0.5), there = untouched.step(0.0015, 0.5);
    EXPECT_EQ(here.force, there.force);
    EXPECT_EQ(here.damping, there.damping);
  }
}

// If this failed, a wall of nothing, as a slider leaves it, would be refused as if its numbers were too large.
TEST(ContactCommand, AcceptsZeroStiffness) {
  const compiler::UpdateLaw law = law_for(R"({"spring": 0})", 0);
  compiler::Evaluation<double> run(law);
  for (double position : {-1e-3, 1e-3, -1e-3}) {
    const command<double> now = run.step(position, 1);
    EXPECT_EQ(now.force, 0);
    EXPECT_EQ(now.damping, 0);
  }
}

}  // namespace dashpot::testing
