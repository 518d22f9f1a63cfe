#include "support/shrink.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "network/law.hpp"

namespace {

using namespace dashpot::testing;
namespace compiler = dashpot::compiler;

template <class LawType>
bool has(const compiler::Network& network, double more_than) {
  return std::any_of(network.elements.begin(), network.elements.end(), [&](const compiler::Element& e) {
    return std::holds_alternative<LawType>(e.law) && compiler::value_of(e.law) > more_than;
  });
}

std::string dislikes_soft_damped_springs(const compiler::Network& network) {
  return has<compiler::Damper>(network, 0) && has<compiler::Spring>(network, 20) ? "spring and damper" : "";
}

// Fails if a failure is reported with elements that have no part in it, or with values that nobody can read.
TEST(Shrink, FindsTheSmallestNetwork) {
  const compiler::Network large = random_network(4);
  ASSERT_GT(large.elements.size(), 10u);
  ASSERT_NE(dislikes_soft_damped_springs(large), "");
  const compiler::Network small = smallest_failing(large, dislikes_soft_damped_springs);
  ASSERT_EQ(small.elements.size(), 2u) << json_text(small);
  for (const compiler::Element& element : small.elements) {
    const bool is_spring = std::holds_alternative<compiler::Spring>(element.law);
    const double power = std::log10(compiler::value_of(element.law));
    EXPECT_EQ(power, std::round(power));
    EXPECT_EQ(power, is_spring ? 2 : 0);
  }
}

// Fails if a failure does not say how to repeat it.
TEST(Shrink, SaysSeedNetworkAndComplaint) {
  const std::string report = first_failure(0, 50, {}, dislikes_soft_damped_springs);
  EXPECT_EQ(report.rfind("seed ", 0), 0u) << report;
  EXPECT_NE(report.find("\"spring\""), std::string::npos) << report;
  EXPECT_NE(report.find("spring and damper"), std::string::npos) << report;
}

// Fails if a property that always holds is reported as broken.
TEST(Shrink, IsSilentWhereNothingFails) {
  EXPECT_EQ(first_failure(0, 50, {}, [](const compiler::Network&) { return ""; }), "");
}

}  // namespace
