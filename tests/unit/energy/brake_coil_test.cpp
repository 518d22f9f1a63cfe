// The coil's closed form: straight, then exponential, at any subdivision of time.
#include <cmath>

#include <gtest/gtest.h>

#include <dashpot/brake_coil.hpp>

namespace dashpot {
namespace {

brake_description slow_brake() {
  brake_description brake;
  brake.damping_per_current_squared = 0.25;
  brake.coil_lag = 0.004;
  brake.slew = 100;
  return brake;
}

// If this failed, the slew limit or the lag would be wrong, or would act on the damping instead of on its root.
TEST(BrakeCoil, SlewsStraightAndThenSettles) {
  brake_coil<double> coil(slow_brake());
  // √κ = 0.5: √b slews at 50 per second, and within 50 · 4 ms = 0.2 of the demand the lag is slower than that.
  EXPECT_NEAR(coil.after(2, 0.010), 0.5, 1e-15);
  EXPECT_NEAR(coil.after(2, 0.036 + 0.008), 2 - 0.2 * std::exp(-2.0), 1e-15);
  coil.advance(2, 0.044);
  EXPECT_NEAR(coil.after(0, 0.010), 2 - 0.2 * std::exp(-2.0) - 0.5, 1e-15);
  EXPECT_NEAR(coil.damping(), coil.root_damping() * coil.root_damping(), 0);
}

// If this failed, the brake would depend on how often it is looked at.
TEST(BrakeCoil, ComposesInTime) {
  brake_coil<double> whole(slow_brake()), parts(slow_brake());
  whole.advance(1.5, 0.050);
  for (int k = 0; k < 50; ++k) parts.advance(1.5, 0.001);
  // Fifty sums of this size.
  EXPECT_NEAR(parts.root_damping(), whole.root_damping(), 50 * 2e-16);
}

// If this failed, a coil whose κ is not known would be given a slew limit, or one without a lag would have one.
TEST(BrakeCoil, UnstatedLimitsDoNotAct) {
  brake_description brake = slow_brake();
  brake.damping_per_current_squared = 0;
  EXPECT_NEAR(brake_coil<double>(brake).after(2, 0.004), 2 * (1 - std::exp(-1.0)), 1e-15);
  brake.coil_lag = 0;
  EXPECT_EQ(brake_coil<double>(brake).after(2, 1e-9), 2);
  EXPECT_EQ(brake_coil<double>().after(2, 1e-9), 2);
}

// If this failed, a led coil would miss what it was led to.
TEST(BrakeCoil, LeadArrivesAtTheEndOfThePeriod) {
  brake_description brake = slow_brake();
  brake.slew = 0;
  brake_coil<double> coil(brake);
  coil.reset(0.3);
  EXPECT_NEAR(coil.after(coil.demand_to_reach(0.7, 0.001), 0.001), 0.7, 1e-15);
  EXPECT_NEAR(coil.after(coil.demand_to_reach(0.1, 0.001), 0.001), 0.1, 1e-15);
}

}  // namespace
}  // namespace dashpot
