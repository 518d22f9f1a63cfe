// What is refused beside tunable parameters, and what is said of those that are compiled.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "discretise/tunable_programs.hpp"
#include "lower/begun_at_rest.hpp"
#include "source/render.hpp"
#include "support/tunable_run.hpp"

namespace dashpot::testing {
namespace {

std::string said_of(const std::string& text, const compiler::Choices& choices = {}) {
  const compiler::SourceFile source("tunable.json", text);
  compiler::Diagnostics diagnostics;
  const bool is_compiled = compiler::compile(source, choices, std::nullopt, diagnostics).has_value();
  return (is_compiled ? "compiled\n" : "refused\n") + compiler::render_text(diagnostics);
}

std::string file(const std::string& structure, const std::string& more = "") {
  return "{ \"dashpot\": 1, \"name\": \"n\", " + more +
         "\"parameters\": { \"K\": { \"value\": 2, \"tunable\": true, \"min\": 1, \"max\": 3 } }, " + structure + " }";
}

std::string repeated(int count, const char* what) {
  std::string list;
  for (int i = 0; i < count; ++i)
    list += fmt::format(", {{ \"series\": [ {{ \"{}\": {} }}, {{ \"spring\": 1 }} ] }}", what, i + 1);
  return file("\"network\": { \"parallel\": [ { \"spring\": \"K\" }" + list + " ] }");
}

void expect(const std::string& said, const std::string& part) { EXPECT_NE(said.find(part), said.npos) << said; }

// If this failed, a network too large for set() would be compiled into one that takes longer than anybody was told.
TEST(TunableRefusal, OfMoreThanThereIsRoomFor) {
  EXPECT_EQ(said_of(repeated(40, "damper")), "compiled\n");
  EXPECT_EQ(said_of(repeated(8, "slip")), "compiled\n");
  const std::string many = said_of(repeated(9, "slip"));
  expect(many, "refused");
  expect(many, "'n' has tunable parameters and 9 slips; at most 8 are compiled with them [too-much-to-tune]");
  expect(many, "note: make the parameters constants");
}

// If this failed, a state that follows an estimate would turn a slider into a source of energy.
TEST(TunableRefusal, OfStatesThatFollowAVelocity) {
  compiler::Choices choices;
  choices.state_input = compiler::StateInput::velocity;
  const std::string said = said_of(file("\"network\": { \"spring\": \"K\" }"), choices);
  expect(said, "refused\n");
  expect(said,
         "error: --state-input velocity cannot be combined with tunable parameters; 'position' is expected "
         "[tunable-needs-position]");
}

// If this failed, slips outside a tree would take longer than anybody was told: their patterns grow as 3ⁿ. One slip
// holds nothing to begin with.
TEST(TunableRefusal, OfManySlipsOutsideATree) {
  const auto ring = [](int slips) {
    std::string elements = R"({ "spring": "K", "nodes": ["tool", "n0"] }, { "slip": "Y", "nodes": ["n0", "n1"] })";
    for (int i = 1; i < slips; ++i)
      elements += fmt::format(", {{ \"slip\": {}, \"nodes\": [\"n{}\", \"n{}\"] }}", i, i, (i + 1) % slips);
    for (int i = 1; i < slips; ++i)
      elements += fmt::format(", {{ \"spring\": {}, \"nodes\": [\"n{}\", \"ground\"] }}", i, i);
    return R"({ "dashpot": 1, "name": "n", "parameters": { "K": { "value": 2, "tunable": true, "min": 1, "max": 3 },
      "Y": { "value": 0, "tunable": true, "min": 0, "max": 3 } }, "elements": [ )" +
           elements + " ] }";
  };
  EXPECT_EQ(said_of(ring(8)), "compiled\n");
  expect(said_of(ring(9)), "'n' has tunable parameters and 9 slips; at most 8 are compiled with them");
}

// If this failed, the brake would stay where the defaults put it while the network changes under it.
TEST(TunableBrake, FollowsTheParameters) {
  const char* const network = R"({ "dashpot": 1, "name": "n",
    "parameters": { "B1": { "value": 5, "tunable": true, "min": 0, "max": 50 }, "K": { "value": 3, "tunable": true, "min": 0, "max": 50 } },
    "network": { "parallel": [ { "series": [ { "damper": "B1" }, { "spring": 12 } ] },
                               { "series": [ { "parallel": [ { "damper": 6 }, { "spring": "K" } ] }, { "spring": 3 } ] }, { "damper": 2 } ] } })";
  const auto damping = [&](const char* decomposition, std::vector<double> values) {
    compiler::Choices choices;
    choices.decomposition = decomposition;
    const TunableLaw law(network, choices);
    compiler::Evaluation<double> run(law.law());
    run.set(values);
    return run.step(0, 0).damping;
  };
  EXPECT_EQ(damping("paper", {5, 3}), 13);
  EXPECT_EQ(damping("paper", {50, 3}), 58);
  EXPECT_EQ(damping("velocity-free", {50, 3}), 2);
  EXPECT_EQ(damping("virtual", {50, 3}), 0);
  // Z(0) of the second branch: 6 (3/(K + 3))², as the spring takes the rest of the motion.
  EXPECT_DOUBLE_EQ(damping("zero-frequency", {50, 3}), 52 + 6 * 0.25);
  EXPECT_DOUBLE_EQ(damping("zero-frequency", {50, 0}), 52 + 6);
  EXPECT_DOUBLE_EQ(damping("quietest-passive", {50, 9}), (52 + 6.0 / 16) / 2);
  EXPECT_DOUBLE_EQ(damping("quietest-passive", {0, 9}), 2);
}

// If this failed, the brake would take nothing of what is behind slips, or keep their damping when they give way. A
// table of patterns in the law without tunables, a walk over the tree in this one.
TEST(TunableBrake, FollowsTheSlipsThatSlide) {
  const char* const network = R"({ "dashpot": 1, "name": "n",
    "parameters": { "Y": { "value": 0.4, "tunable": true, "min": 0.1, "max": 5 }, "B": { "value": 2, "tunable": true, "min": 0, "max": 8 } },
    "network": { "series": [ { "parallel": [ { "damper": "B" }, { "series": [ { "spring": 300 }, { "slip": 1 } ] } ] },
                             { "parallel": [ { "slip": "Y" }, { "damper": 3 } ] } ] } })";
  const TunableLaw law(network);
  compiler::Evaluation<double> run(law.law());
  const auto pressed = [&](double to, double speed) { return run.step(to, speed).damping; };
  // 2 N·s/m carry 0.2 N at 0.1 m/s, less than the 0.4 N that the slip holds; at 1 m/s it gives way, and 3 N·s/m are in
  // series.
  EXPECT_EQ(pressed(1e-4, 0.1), 2);
  EXPECT_DOUBLE_EQ(pressed(1.1e-3, 1), 2 * 3 / 5.0);
  run.set({5, 6});
  run.reset();
  EXPECT_EQ(pressed(1e-4, 0.1), 6);
  EXPECT_EQ(pressed(6e-4, 0.5), 6);
  EXPECT_DOUBLE_EQ(pressed(2.6e-3, 2), 6 * 3 / 9.0);
  EXPECT_EQ(run.step(std::nan(""), 0).damping, 6 * 3 / 9.0);
}

// If this failed, outside a tree the brake would take a slip's ends for joined when it slides, or for apart when it
// holds: a bridge of dampers whose middle is a slip.
TEST(TunableBrake, FollowsSlipsOutsideATree) {
  const char* const bridge = R"({ "dashpot": 1, "name": "n",
    "parameters": { "Y": { "value": 0.2, "tunable": true, "min": 0, "max": 5 }, "B": { "value": 1, "tunable": true, "min": 0, "max": 8 } },
    "elements": [ { "damper": 2, "nodes": ["tool", "a"] }, { "damper": 3, "nodes": ["tool", "b"] }, { "slip": "Y", "nodes": ["a", "b"] },
      { "damper": 4, "nodes": ["a", "ground"] }, { "damper": "B", "nodes": ["b", "ground"] } ] })";
  const TunableLaw law(bridge);
  compiler::Evaluation<double> run(law.law());
  const auto held = [](double b) { return 1 / (1 / 5.0 + 1 / (4 + b)); };
  const auto open = [](double b) { return 1 / (1 / 2.0 + 1 / 4.0) + 1 / (1 / 3.0 + 1 / b); };
  double position = 0;
  const auto pressed = [&](double speed) { return run.step(position += speed * 1e-3, speed).damping; };
  EXPECT_DOUBLE_EQ(pressed(0.1), held(1));
  EXPECT_DOUBLE_EQ(pressed(0.5), open(1));
  EXPECT_DOUBLE_EQ(pressed(0.1), held(1));
  run.set({5, 8});
  EXPECT_DOUBLE_EQ(pressed(0.5), held(8));
  run.set({0, 8});
  EXPECT_DOUBLE_EQ(pressed(0.5), open(8));
}

// If this failed, a coil that lags would be told to jump, or a count of the encoder there and back to let go.
TEST(TunableBrake, GoesNoFasterThanItsCoil) {
  const char* const network = R"({ "dashpot": 1, "name": "n",
    "parameters": { "Y": { "value": 0.4, "tunable": true, "min": 0.1, "max": 5 } },
    "network": { "series": [ { "parallel": [ { "spring": 500 }, { "damper": 5 } ] }, { "slip": "Y" } ] } })";
  const TunableLaw compiled(network);
  compiler::UpdateLaw law = compiled.law();
  law.tunable->head.slip_rule = {true, 1e-4, 0.1};
  law = compiler::begun_at_rest(compiler::with_programs(std::move(law)));
  compiler::Evaluation<double> run(law);
  double root = std::sqrt(5.0);
  const auto expect = [&](double position, double velocity, double goal) {
    root += 0.1 * (goal - root);
    EXPECT_NEAR(run.step(position, velocity).damping, root * root, 1e-12) << position;
  };
  for (int n = 1; n <= 50; ++n) expect(1e-3 * n, 1, 0);
  // Within the hysteresis it slides for the command, beyond it holds.
  for (int n = 0; n < 10; ++n) expect(0.05 - 0.9e-4, 0, 0);
  for (int n = 0; n < 10; ++n) expect(0.05 - 1.1e-4, 0, std::sqrt(5.0));
}

}  // namespace
}  // namespace dashpot::testing
