#include "network/network.hpp"

#include <gtest/gtest.h>

#include <variant>

#include "front_end_run.hpp"

namespace dashpot::compiler {
namespace {

// The example of the format's reference.
const std::string second_order_maxwell = R"({
  "dashpot": 1,
  "name": "second_order_maxwell",
  "title": "General viscoelastic solid, Fig. 2e",
  "source": "Gosline & Hayward 2009, Fig. 5",
  "motion": "translation",
  "parameters": { "K1": { "value": "12 N/m", "tunable": true, "min": "0 N/m", "max": "100 N/m" } },
  "network": { "parallel": [
      { "series": [ { "damper": "5 N s/m", "name": "B1" }, { "spring": "K1" } ] },
      { "series": [ { "damper": "6 N s/m" }, { "spring": "10 N/m" } ] },
      { "spring": "5 N/m", "name": "K3" } ] }
})";

std::string file_with(const std::string& keys) { return R"({"dashpot": 1, "name": "sample", )" + keys + "}"; }

// If this fails, the printed network is not what was written, or no longer says all of it.
TEST(Network, PrintsWhatWasWritten) {
  const NetworkRun run(second_order_maxwell);
  ASSERT_TRUE(run.network) << run.said();
  EXPECT_EQ(run.said(), "");
  EXPECT_EQ(to_text(*run.network), R"(network second_order_maxwell: translation
  title: General viscoelastic solid, Fig. 2e
  source: Gosline & Hayward 2009, Fig. 5
  parameter K1 = 12, tunable 0 … 100
  damper B1 5 N s/m: tool – node_1
  spring spring_2 K1 = 12 N/m: node_1 – ground
  damper damper_3 6 N s/m: tool – node_2
  spring spring_4 10 N/m: node_2 – ground
  spring K3 5 N/m: tool – ground
)");
}

// If this fails, a later stage looks at the wrong parameter, or at the wrong end of an element.
TEST(Network, OfATreeRunsFromToolToGround) {
  const NetworkRun run(second_order_maxwell);
  ASSERT_TRUE(run.network) << run.said();
  const Element& damper = run.network->elements[0];
  const Element& spring = run.network->elements[1];
  EXPECT_EQ(damper.a, tool);
  EXPECT_EQ(damper.b, spring.a);
  EXPECT_EQ(spring.b, ground);
  EXPECT_EQ(spring.parameter, 0u);
  EXPECT_EQ(damper.parameter, std::nullopt);
  EXPECT_EQ(run.network->parameters[0].max, 100);
  EXPECT_EQ(run.network->nodes, (std::vector<std::string>{"ground", "tool", "node_1", "node_2"}));
}

// If this fails, tree and netlist of one network are two networks.
TEST(Network, MayBeWrittenAsElements) {
  const NetworkRun run(file_with(R"("motion": "rotation", "elements": [
      {"spring": "2 N m/rad", "nodes": ["tool", "a"], "name": "K1"}, {"damper": 3, "nodes": ["ground", "a"]},
      {"slip": "4 mN m", "nodes": ["ground", "b"]}, {"spring": "5 mN m/mrad", "nodes": ["b", "tool"]}])"));
  ASSERT_TRUE(run.network) << run.said();
  const std::vector<Element>& elements = run.network->elements;
  EXPECT_EQ(run.network->port_motion, motion::rotation);
  EXPECT_EQ(run.network->nodes, (std::vector<std::string>{"ground", "tool", "a", "b"}));
  EXPECT_EQ(std::get<Spring>(elements[0].law).stiffness, 2);
  EXPECT_EQ(std::get<Damper>(elements[1].law).damping, 3);
  EXPECT_EQ(std::get<Slip>(elements[2].law).yield_force, 0.004);
  EXPECT_EQ(std::get<Spring>(elements[3].law).stiffness, 5);
  EXPECT_EQ(elements[1].name, "damper_2");
  EXPECT_EQ(elements[1].a, ground);
  EXPECT_EQ(elements[1].b, 2u);
}

// If this fails, a generated name is the same as a name that the author gave to something else.
TEST(Network, GivesUnnamedElementsFreeNames) {
  const NetworkRun run(file_with(R"("parameters": {"damper_2": 1}, "network": {"parallel": [
      {"spring": 1}, {"damper": "damper_2"}, {"spring": 2, "name": "Spring_1"}, {"slip": 1, "name": "s"}, {"spring": 3}]})"));
  std::vector<std::string> names;
  const NetworkRun linear(file_with(R"("parameters": {"damper_2": 1}, "network": {"parallel": [
      {"spring": 1}, {"damper": "damper_2"}, {"spring": 2, "name": "Spring_1"}, {"spring": 3}]})"));
  ASSERT_TRUE(linear.network) << linear.said();
  for (const Element& element : linear.network->elements) names.push_back(element.name);
  EXPECT_EQ(names, (std::vector<std::string>{"spring_1_2", "damper_2_2", "Spring_1", "spring_4"}));
  EXPECT_FALSE(run.network) << "a slip alone joins tool and ground";
}

// If this fails, limits of validity and the place of the contact do not reach the stages that need them.
TEST(Network, CarriesContactAndValidity) {
  const NetworkRun run(file_with(R"("parameters": {"depth": "2 mm"}, "network": {"spring": 5},
      "contact": {"at": "depth"}, "valid": {"rate": "20 mm/s", "displacement": "3 mm", "frequency": ["25 Hz", 62.5]})"));
  ASSERT_TRUE(run.network) << run.said();
  EXPECT_EQ(run.said(), "");
  EXPECT_EQ(run.network->contact->at, 0.002);
  EXPECT_EQ(run.network->valid.rate->low, 0);
  EXPECT_EQ(run.network->valid.rate->high, 0.02);
  EXPECT_EQ(run.network->valid.displacement->low, -0.003);  // a single bound is one of magnitude
  EXPECT_EQ(run.network->valid.displacement->high, 0.003);
  EXPECT_TRUE(run.network->valid.frequency->contains(62.5));
  EXPECT_FALSE(run.network->valid.frequency->contains(24.9));
  EXPECT_NE(to_text(*run.network).find("  contact at 0.002 m\n  valid rate 0 … 0.02 m/s\n"), std::string::npos);
}

// If this fails, networks of zero stiffness or damping, which users tune from, are refused or lose elements.
TEST(Network, KeepsElementsOfValueZero) {
  const NetworkRun run(file_with(R"("network": {"parallel": [{"spring": "0 N/m"}, {"damper": 0}, {"spring": 2}]})"));
  ASSERT_TRUE(run.network) << run.said();
  ASSERT_EQ(run.network->elements.size(), 3u);
  EXPECT_FALSE(run.network->elements[0].has_effect);
  EXPECT_FALSE(run.network->elements[1].has_effect);
  EXPECT_TRUE(run.network->elements[2].has_effect);
}

// If this fails, a slip that can be tuned down to zero, which holds nothing while it is, cannot be written.
TEST(Network, TakesAYieldThatCanBeTunedToZero) {
  const NetworkRun run(file_with(R"("parameters": {"Y": {"value": "0 N", "tunable": true, "min": 0, "max": "2 N"}},
      "network": {"series": [{"slip": "Y"}, {"spring": 5}]})"));
  EXPECT_TRUE(run.network) << run.said();
}

// If this fails, two files with different content can be told by nothing in the emitted code.
TEST(Network, CarriesTheDigestOfItsFile) {
  const NetworkRun run(second_order_maxwell);
  const NetworkRun other(second_order_maxwell + " ");
  ASSERT_TRUE(run.network && other.network);
  EXPECT_EQ(run.network->digest.size(), 64u);
  EXPECT_NE(run.network->digest, other.network->digest);
}

// If this fails, one mistake hides the next, and authors correct their files line by line.
TEST(Network, IsRefusedForAllReasonsAtOnce) {
  const NetworkRun run(
      file_with(R"("colour": 1, "network": {"series": [{"spring": -1}, {"mass": 2}, {"damper": "K"}]})"));
  EXPECT_FALSE(run.network);
  EXPECT_EQ(run.diagnostics.error_count(), 4u) << run.said();
}

}  // namespace
}  // namespace dashpot::compiler
