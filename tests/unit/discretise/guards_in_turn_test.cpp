// Guards against subnormal forces that go round the places of a rolled loop: none may come too late.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "compiled.hpp"
#include "law/evaluate.hpp"
#include "law/cost.hpp"
#include "law/walk.hpp"

namespace {

using namespace dashpot::compiler;

// 64 branches of 1 N/m; the slowest relaxes at 1/s, the fastest at this rate [1/s].
Compiled branches(double fastest, const Choices& choices = {}) {
  std::string text;
  for (int i = 0; i < 64; ++i)
    text += fmt::format("{}{{ \"series\": [ {{ \"spring\": 1 }}, {{ \"damper\": {:.17g} }} ] }}", i == 0 ? "" : ",",
                        std::pow(fastest, -i / 63.0));
  return Compiled(network_text("{ \"parallel\": [" + text + "] }"), choices);
}

// Bits that the fastest force loses from one guard to the next, were `places` guarded a sample; 1 kHz.
double bits_between(double fastest, std::size_t places) { return fastest * 1e-3 / std::log(2.0) * 64 / double(places); }

// If this failed, a force would be subnormal before its guard came, or its square far below; or more would be guarded
// than has to be.
TEST(GuardsInTurn, GuardIntervalPreventsSubnormals) {
  for (const double fastest : {2.0, 1e3, 15e3, 20e3, 30e3, 60e3}) {
    const Compiled compiled = branches(fastest);
    ASSERT_EQ(compiled.law().guards.size(), 1u) << fastest;
    const std::size_t places = compiled.law().guards.front().places;
    EXPECT_LE(bits_between(fastest, places), 200) << fastest;
    if (places > lanes_of_loops(compiled.law()).count) {
      EXPECT_GT(bits_between(fastest, places / 2), 200) << fastest;
    }
    EXPECT_EQ(cost_of(compiled.law(), compiled.law().update).guards, places) << fastest;
  }
}

// If this failed, some force would go without its guard: where half of the forces a sample are too few, in float, whose
// threshold's square is barely normal, or on demand.
TEST(GuardsInTurn, ApplyToSlowForcesInDoubleOnly) {
  Choices in_float, on_demand;
  in_float.scalar = ScalarType::float32;
  on_demand.guards_each_sample = true;
  for (const Compiled& compiled : {branches(80e3), branches(1e3, in_float), branches(1e3, on_demand)}) {
    EXPECT_TRUE(compiled.law().guards.empty());
    EXPECT_EQ(cost_of(compiled.law(), compiled.law().update).guards, 64u);
  }
}

// If this failed, some place would never be guarded, or too late.
TEST(GuardsInTurn, GuardEveryForceInTime) {
  for (const double fastest : {2.0, 1e3, 30e3}) {
    const Compiled compiled = branches(fastest);
    Evaluation<double> law(compiled.law());
    law.reset();
    // One way alone, then held at 0: all forces have one sign, none can hide another.
    for (int i = 0; i < 10; ++i) law.step(1e-3 * (i - 10), 1);
    double force = 1;
    for (int i = 0; i < 200000 && force != 0; ++i) {
      force = law.step(0, 0).force;
      ASSERT_TRUE(force == 0 || std::abs(force) > 0x1p-400) << fastest << " sample " << i;
      ASSERT_TRUE(law.stored_energy() == 0 || law.stored_energy() > 0x1p-810) << fastest << " sample " << i;
    }
    EXPECT_EQ(force, 0) << fastest;
  }
}

}  // namespace
