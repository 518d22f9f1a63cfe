// What an emitted header says that a set() costs.
#include <gtest/gtest.h>

#include "law/cost.hpp"
#include "support/tunable_run.hpp"

namespace dashpot::testing {
namespace {

// If this failed, what a change costs would be most of a period on a board: a standard solid's constants, and a
// Kelvin's.
TEST(TunableCost, OfConstantsIsSmall) {
  const auto cost = [](const char* network) {
    const TunableLaw compiled(network);
    return compiler::operations_of(compiler::cost_of(compiled.law(), compiled.law().tune));
  };
  EXPECT_LE(cost(R"({ "dashpot": 1, "name": "solid",
    "parameters": { "K1": { "value": 200, "tunable": true, "min": 50, "max": 800 } },
    "network": { "series": [ { "parallel": [ { "spring": "K1" }, { "damper": 8 } ] }, { "spring": 600 } ] } })"),
            60u);
  EXPECT_LE(cost(R"({ "dashpot": 1, "name": "kelvin",
    "parameters": { "K": { "value": 200, "tunable": true, "min": 50, "max": 800 },
                    "B": { "value": 2, "tunable": true, "min": 0, "max": 8 } },
    "network": { "parallel": [ { "spring": "K" }, { "damper": "B" } ] } })"),
            12u);
}

}  // namespace
}  // namespace dashpot::testing
