#include "fig3.hpp"

#include <gtest/gtest.h>

#include "says.hpp"
#include <algorithm>

namespace {

using namespace dashpot::paper;

const Fig3& fig3() { return measured_fig3(); }

constexpr double rounding = 1e-9;  // [N·s/m]
constexpr std::size_t five_ms = 5;

double most(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

// Fails if an observer with an exact brake is active under some delay: the tool-damper theorem (theory, section 4)
// forbids it.
TEST(Fig3, IsPassiveUnderAnyDelayWhicheverElementIsObserved) {
  for (const Fig3::Case& each : fig3().cases)
    for (std::size_t observed = 0; observed < 2; ++observed)
      EXPECT_LT(most(each.observers[observed].missing), rounding) << each.title;
  for (const Fig3::Poll& poll : fig3().polls) EXPECT_EQ(poll.less_missing, poll.pairs) << poll.rule;
}

// Fails if the single motor is passive at a delay: then the brake would gain nothing.
TEST(Fig3, IsActiveByTheSingleMotorAtEveryDelay) {
  for (const Fig3::Case& each : fig3().cases)
    for (std::size_t k = 1; k < fig3().delays.size(); ++k)
      EXPECT_GT(each.observers[3].missing[k], 0.5 * each.observers[2].brake) << each.title;
}

// Fails if equal elements are not one element of half the damping: observed singly they err, merged they do not.
TEST(Fig3, MergesEqualElements) {
  const Fig3::Case& equal = fig3().cases[0];
  EXPECT_NEAR(equal.observers[2].brake, 2.5, rounding);
  EXPECT_LT(equal.observers[2].error[five_ms], rounding);
  EXPECT_NEAR(equal.observers[0].error[five_ms], 0.129, 0.001);
}

// Fails if theory's own example does not come out: at 0.5 Hz and 5 ms b = 10 is 47 % wrong (theory says 46, in time and
// not at one frequency), b = 0.1 is not wrong by a thousandth of a percent.
TEST(Fig3, ObservesTheSoftElementOfTheorysExample) {
  const Fig3::Case& unequal = fig3().cases[2];
  EXPECT_GT(unequal.pair.share(2), 1000 * unequal.pair.share(1));
  EXPECT_NEAR(unequal.observers[0].slow_error[five_ms], 0.471, 0.002);
  EXPECT_LT(unequal.observers[1].slow_error[five_ms], 1e-5);
}

// Fails if what the page says of the rules changes: of random pairs at 5 ms, below 5 Hz, neither the larger share nor
// the larger damping is the better observer more often than not; the smaller damping is.
TEST(Fig3, ErrsLeastByTheSmallerDampingMoreOftenThanByAnyRule) {
  EXPECT_NEAR(fig3().polls[0].share(&Fig3::Poll::less_error), 0.464, 0.01);
  EXPECT_NEAR(fig3().polls[1].share(&Fig3::Poll::less_error), 0.113, 0.01);
  EXPECT_NEAR(fig3().polls[2].share(&Fig3::Poll::less_error), 0.887, 0.01);
  EXPECT_NEAR(fig3().polls[0].share(&Fig3::Poll::less_slow_error), 0.574, 0.01);
}

// Fails if with a brake that is short the smaller damping ever needs more than the larger.
TEST(Fig3, NeedsLeastByTheSmallerDampingWithAShortBrake) {
  EXPECT_EQ(fig3().polls[2].less_missing_when_short, fig3().polls[2].pairs);
}

// Fails if the words stay when the numbers change sides.
TEST(Fig3, SaysWhatTheNumbersSay) {
  EXPECT_TRUE(says(show(fig3()), "the paper’s rule does not come out"));
  EXPECT_TRUE(says(show(fig3()), "every observer is passive under any delay"));
  Fig3 other = fig3();
  other.polls[1].less_error = other.polls[1].pairs;
  EXPECT_TRUE(says(show(other), "the paper’s rule comes out"));
  other.cases[0].observers[0].missing[3] = 1;
  EXPECT_FALSE(says(show(other), "every observer is passive under any delay"));
}

}  // namespace
