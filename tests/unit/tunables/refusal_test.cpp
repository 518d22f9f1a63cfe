// What is refused beside tunable parameters, and what is said of those that are compiled.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "source/render.hpp"
#include "tunable_run.hpp"

namespace dashpot::testing {
namespace {

std::string said_of(const std::string& text, const compiler::Choices& choices = {}) {
  const compiler::SourceFile source("tunable.json", text);
  compiler::Diagnostics diagnostics;
  const bool is_compiled = compiler::compile(source, choices, std::nullopt, diagnostics).has_value();
  return (is_compiled ? "compiled\n" : "refused\n") + compiler::render_text(diagnostics);
}

std::string file(const std::string& structure, const std::string& more = "") {
  return "{ \"dashpot\": 1, \"name\": \"n\", " + more + "\"parameters\": { \"K\": { \"value\": 2, \"tunable\": true, \"min\": 1, \"max\": 3 } }, " +
         structure + " }";
}

std::string repeated(int count, const char* what) {
  std::string list;
  for (int i = 0; i < count; ++i) list += fmt::format(", {{ \"series\": [ {{ \"{}\": {} }}, {{ \"spring\": 1 }} ] }}", what, i + 1);
  return file("\"network\": { \"parallel\": [ { \"spring\": \"K\" }" + list + " ] }");
}

void expect(const std::string& said, const std::string& part) { EXPECT_NE(said.find(part), said.npos) << said; }

// A network too large for set() would be compiled into one that takes longer than anybody was told.
TEST(TunableRefusal, of_more_than_there_is_room_for) {
  EXPECT_EQ(said_of(repeated(16, "damper")), "compiled\n");
  const std::string many = said_of(repeated(17, "damper"));
  expect(many, "refused");
  expect(many, "'n' has tunable parameters and 17 relaxations; at most 16 are compiled with them [too-much-to-tune]");
  expect(many, "note: make the parameters constants");
  EXPECT_EQ(said_of(repeated(8, "slip")), "compiled\n");
  expect(said_of(repeated(9, "slip")), "9 slips; at most 8 are compiled");
}

// A state that follows an estimate would turn a slider into a source of energy.
TEST(TunableRefusal, of_states_that_follow_a_velocity) {
  compiler::Choices choices;
  choices.state_input = compiler::StateInput::velocity;
  expect(said_of(file("\"network\": { \"spring\": \"K\" }"), choices),
         "refused\nerror: state input 'velocity' with tunable parameters; their states follow the position [tunable-needs-position]");
}

// Slips in no tree would be stepped by a law that knows nothing of them.
TEST(TunableRefusal, of_slips_outside_a_tree) {
  const std::string bridge = said_of(file(R"("elements": [ { "spring": "K", "nodes": ["tool", "a"] }, { "spring": 1, "nodes": ["tool", "b"] },
    { "slip": 1, "nodes": ["a", "b"] }, { "spring": 1, "nodes": ["a", "ground"] }, { "damper": 1, "nodes": ["b", "ground"] } ])"));
  expect(bridge, "refused");
}

// The brake would stay where the defaults put it while the network changes under it.
TEST(TunableBrake, follows_the_parameters) {
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
  EXPECT_EQ(damping("most-dissipative", {5, 3}), 13);
  EXPECT_EQ(damping("most-dissipative", {50, 3}), 58);
  EXPECT_EQ(damping("velocity-free", {50, 3}), 2);
  EXPECT_EQ(damping("virtual", {50, 3}), 0);
  // Z(0) of the second branch: 6 (3/(K + 3))², as the spring takes the rest of the motion.
  EXPECT_DOUBLE_EQ(damping("zero-frequency", {50, 3}), 52 + 6 * 0.25);
  EXPECT_DOUBLE_EQ(damping("zero-frequency", {50, 0}), 52 + 6);
  EXPECT_DOUBLE_EQ(damping("quietest-passive", {50, 9}), (52 + 6.0 / 16) / 2);
  EXPECT_DOUBLE_EQ(damping("quietest-passive", {0, 9}), 2);
}

}  // namespace
}  // namespace dashpot::testing
