#include "fig5_section.hpp"

#include <gtest/gtest.h>

#include "chosen.hpp"
#include "fig5_figure.hpp"

namespace {

using namespace dashpot::paper;

// Fails if the exact scheme is not the closed form (6) and its continuation, to rounding.
TEST(Fig5, IsTheClosedFormByTheExactScheme) { EXPECT_LT(relative_error(measure_fig5().exact), 1e-12); }

// Fails if the paper's scheme errs otherwise than by hand from (13) and (15).
TEST(Fig5, ErrsAsKnownByBackwardEuler) {
  const auto euler = measure_fig5().euler;
  EXPECT_NEAR(relative_error(euler), fig5::euler_error, fig5::euler_error_digits);
  EXPECT_EQ(worst(euler).time, fig5::euler_error_time);
}

// Fails if the brake's part is not b u̇ with the dampers of both Maxwell elements, or the parts do not add up to the
// force.
TEST(Fig5, GivesTheDampersToTheBrakeAndTheRestToTheMotor) {
  for (const auto& sample : measure_fig5().exact) {
    EXPECT_EQ(sample.brake, 11 * fig5::insertion.velocity(sample.time)) << sample.time;
    EXPECT_NEAR(sample.brake + sample.motor, sample.closed_form, 1e-12) << sample.time;
  }
}

// Fails if the program of ./try, which reads no file, assumes another rate than the one that is chosen for it.
TEST(Fig5, HasTheChosenRate) { EXPECT_EQ(fig5::insertion.rate, chosen("fig5.rate")); }

}  // namespace
