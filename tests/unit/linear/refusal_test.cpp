// What has no dynamic stiffness is refused before any matrix is formed.
#include <gtest/gtest.h>

#include <stdexcept>

#include "support/written_network.hpp"

namespace {

using dashpot::testing::written_network;

std::string refusal(const std::string& structure) {
  try {
    written_network(structure);
  } catch (const std::invalid_argument& diagnostics) {
    return diagnostics.what();
  }
  return "";
}

// Fails if a tool that nothing holds gets a force.
TEST(Refusal, OfAToolWithoutConnectionToGround) {
  const std::string text =
      refusal(R"([ { "spring": 1, "nodes": ["tool", "a"] }, { "damper": 1, "nodes": ["b", "ground"] } ])");
  EXPECT_NE(text.find("[ends-not-connected]"), std::string::npos) << text;
}

// Fails if a part that floats free becomes a singular matrix instead of a message.
TEST(Refusal, OfAPartTiedToNothing) {
  const std::string text = refusal(R"([ { "spring": 1, "nodes": ["tool", "ground"] },
                                        { "spring": 1, "nodes": ["a", "b"] }, { "damper": 2, "nodes": ["a", "b"] } ])");
  EXPECT_NE(text.find("[floating-part]"), std::string::npos) << text;
}

// Fails if a network without an end at the tool is accepted.
TEST(Refusal, OfANetworkBesideTheTool) {
  const std::string text = refusal(R"([ { "spring": 1, "nodes": ["a", "ground"] } ])");
  EXPECT_NE(text.find("[end-unused]"), std::string::npos) << text;
}

}  // namespace
