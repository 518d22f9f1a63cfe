// The independent integrator of linear networks against the closed form of one.
#include <gtest/gtest.h>

#include "ramp_response.hpp"
#include "support/written_network.hpp"

namespace dashpot::testing {
namespace {

// Equation (6) of a spring, a damper and two Maxwell elements, relaxation times ten decades apart: the integrator would
// be no judge of laws that claim 12 digits.
TEST(RampResponse, IsTheClosedFormOfAMaxwellNetwork) {
  const double period = 1e-3;
  const std::vector<Exact> ramp = ramp_response(
      written_network(R"({"parallel": [{"spring": 5}, {"damper": 7}, {"series": [{"spring": 1e4}, {"damper": 1e-2}]},
                          {"series": [{"spring": 1e-2}, {"damper": 1e2}]}]})"),
      period, 32);
  for (std::size_t k = 1; k <= ramp.size(); ++k) {
    const Exact t = Exact(k) * period;
    const Exact expected =
        5 * t + 7 + Exact(1e-2) * (1 - exp(-1e4 / Exact(1e-2) * t)) + 100 * (1 - exp(-Exact(1e-2) / 100 * t));
    EXPECT_LT(abs(ramp[k - 1] - expected).convert_to<double>(), 1e-18 * expected.convert_to<double>()) << k;
  }
}

// The convolution would take the velocities of other periods.
TEST(RampResponse, GivesTheForceOfASpringAndDamper) {
  const double period = 0.5;
  const std::vector<Exact> ramp =
      ramp_response(written_network(R"({"parallel": [{"spring": 5}, {"damper": 7}]})"), period, 4);
  const std::vector<double> forces = force_by_ramps(ramp, {1, 1, -1, 0}, period);
  EXPECT_NEAR(forces[0], 5 + 14, 1e-14);
  EXPECT_NEAR(forces[1], 5, 1e-14);
  EXPECT_NEAR(forces[2], -5 - 28, 1e-14);
  EXPECT_NEAR(forces[3], 14, 1e-14);
}

}  // namespace
}  // namespace dashpot::testing
