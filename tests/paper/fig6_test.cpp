#include "fig6.hpp"

#include <gtest/gtest.h>

#include "says.hpp"
#include "evaluated_law.hpp"

namespace {

using namespace dashpot::paper;

const Fig6& fig6() {
  static const Fig6 measured = measure_fig6();
  return measured;
}

constexpr double hundredth_of_a_percent = 1e-4;

// Fails if a law, the brake's part or the drive of the states is not what theory, section 4, states for backward Euler.
TEST(Fig6, ErrsAsTheoryStatesWithBackwardEuler) {
  const auto& c = fig6().candidates;
  EXPECT_NEAR(c[0].relative_error, 1.496e-2, hundredth_of_a_percent);
  EXPECT_NEAR(c[1].relative_error, 0.590e-2, hundredth_of_a_percent);
  EXPECT_NEAR(c[2].relative_error, 1.534e-2, hundredth_of_a_percent);
  EXPECT_NEAR(c[3].relative_error, 0.141e-2, hundredth_of_a_percent);
}

// Fails likewise for the exact scheme.
TEST(Fig6, ErrsAsTheoryStatesWithTheExactScheme) {
  const auto& c = fig6().candidates;
  EXPECT_NEAR(c[4].relative_error, 1.363e-2, hundredth_of_a_percent);
  EXPECT_NEAR(c[5].relative_error, 0.575e-2, hundredth_of_a_percent);
  EXPECT_NEAR(c[6].relative_error, 1.643e-2, hundredth_of_a_percent);
  EXPECT_NEAR(c[7].relative_error, 0.00025e-2, hundredth_of_a_percent / 100);
}

// Fails if what all are held against is not the solution of the element's differential equation.
TEST(Fig6, HoldsThemAgainstTheIdealElement) {
  constexpr double last_digit = 1e-5;
  EXPECT_NEAR(fig6_force(0.10), 0.57253, last_digit);
  EXPECT_NEAR(fig6_force(0.25), 2.32435, last_digit);
  EXPECT_NEAR(fig6_force(0.50), 4.56048, last_digit);
  EXPECT_NEAR(fig6_force(1.00), 1.42976, last_digit);
  EXPECT_NEAR(fig6_force(1.50), -4.55085, last_digit);
}

// Fails if the paper's claim does not come out: the single motor gives back more than the element stored, the dual
// channel less.
TEST(Fig6, ReturnsMostEnergyByTheSingleMotor) {
  constexpr double two_hundredths_of_a_millijoule = 0.02e-3;
  EXPECT_NEAR(fig6().candidates[0].returned, 8.20e-3, two_hundredths_of_a_millijoule);
  EXPECT_NEAR(fig6().returned, 7.07e-3, two_hundredths_of_a_millijoule);
  EXPECT_NEAR(fig6().candidates[1].returned, 7.02e-3, two_hundredths_of_a_millijoule);
}

// Fails if the dual channel of the paper needs damping beside its brake, which theory's half-viscosity theorem rules
// out but for the hold's, or if the single motor needs none.
TEST(Fig6, NeedsDampingInTheSingleMotorAlone) {
  EXPECT_GT(fig6().candidates[0].minimum_damping, 0.2);
  EXPECT_EQ(fig6().candidates[1].minimum_damping, 0);
}

// Fails if the scan over frequencies and the compiler's certificate, which bounds them all, disagree about the law that
// both know.
TEST(Fig6, NeedsWhatTheCertificateSays) {
  dashpot::compiler::Choices choices;
  choices.rate = 1000;
  choices.decomposition = "virtual";
  choices.state_input = dashpot::compiler::StateInput::position;
  dashpot::compiler::SampledLoop loop;
  loop.sample_period = 1e-3;
  const Compiled law = compiled(maxwell_element(50, 5), choices);
  const auto bound = dashpot::compiler::passivity_bound(dashpot::compiler::motor_constants(law->law), loop);
  EXPECT_NEAR(fig6().candidates[7].minimum_damping, bound.needed, 1e-6 * bound.needed);
}

// Fails if force and velocity are not opposed after the reversal: (14) would be within a damper's reach.
TEST(Fig6, ShowsWhereNoDamperMakesTheForce) {
  EXPECT_GT(fig6().unreachable, 0.05);
  EXPECT_GT(fig6_force(1.0 + fig6().unreachable / 2), 0);
}

// Fails if a reading of (20), as printed or summed, no longer has the order that the paper describes.
TEST(Fig6, HasThePapersOrderByBothReadingsOf20) {
  for (const auto reading : {&Readings::increment, &Readings::sum}) {
    const Fall &truth = fig6().readings.*reading, &single = fig6().candidates[0].readings.*reading,
               &dual = fig6().candidates[1].readings.*reading;
    EXPECT_TRUE(single.exceeds(truth));
    EXPECT_TRUE(single.exceeds(dual));
    EXPECT_LT(dual.depth, truth.depth);
  }
}

// Fails if the increment of (20) is not what flows in a sample: after the reversal f is still 1.43 N and falls by about
// 14 N/s while u̇ goes down by π m/s², so that f u̇ Δt is least, −0.11 mJ, some 50 ms later.
TEST(Fig6, Reads20AsPrintedASampleAtATime) {
  EXPECT_NEAR(fig6().readings.increment.depth, 0.110e-3, 0.002e-3);
  EXPECT_NEAR(fig6().readings.sum.depth, fig6().returned, 1e-12);
}

// Fails if the words stay when the numbers change sides.
TEST(Fig6, SaysWhatTheNumbersSay) {
  EXPECT_TRUE(says(show(fig6()), "the order that the paper shows comes out"));
  EXPECT_FALSE(says(show(fig6()), "does not come out for"));
  Fig6 other = fig6();
  std::swap(other.candidates[0].returned, other.candidates[1].returned);
  EXPECT_TRUE(says(show(other), "the order that the paper shows does not come out"));
  other = fig6();
  other.candidates[0].readings.increment.depth = 0;
  EXPECT_TRUE(says(show(other), "the paper’s claim does not come out for the single motor"));
  other = fig6();
  other.candidates[1].readings.sum.depth = 1;
  EXPECT_TRUE(says(show(other), "does not come out for the dual channel"));
}

}  // namespace
