// Equal relaxation times are one mode, and modes that cannot be seen from the tool are none.
#include <gtest/gtest.h>

#include "linear_form_of.hpp"

namespace {

using namespace dashpot::testing;
using namespace dashpot::compiler;

// Fails if Maxwell elements of one relaxation time stay apart, or if their stiffnesses do not add.
TEST(Merging, AddsEqualRelaxationTimes) {
  const LinearForm form = form_of(R"({ "parallel": [ { "series": [ { "spring": 2 }, { "damper": 1 } ] },
                                                     { "series": [ { "spring": 6 }, { "damper": 3 } ] } ] })");
  ASSERT_EQ(form.modes.size(), 1u);
  EXPECT_LT(abs(form.modes[0].stiffness - 8), rounding);
  EXPECT_LT(abs(form.modes[0].relaxation_rate - 2), rounding);
  EXPECT_EQ(form.modes[0].elements.size(), 4u);
}

Mode mode(const char* stiffness, const char* rate, std::size_t element) {
  return {Real(stiffness), Real(rate), 1, {element}};
}

LinearForm one_mode(const Mode& mode) {
  LinearForm form;
  form.modes = {mode};
  return form;
}

// Fails if rates within 1e-12 do not merge, or if merging changes D at either end of the frequency axis.
TEST(Merging, KeepsBothEndsOfTheSpectrum) {
  const Mode first = mode("3", "2", 0), second = mode("5", "2.0000000000015", 1);
  const LinearForm both = in_parallel(one_mode(first), one_mode(second));
  ASSERT_EQ(both.modes.size(), 1u);
  EXPECT_LT(abs(both.modes[0].stiffness - 8), rounding);
  EXPECT_LT(abs(both.modes[0].damping() - first.damping() - second.damping()), rounding);
  EXPECT_EQ(both.modes[0].elements, (std::vector<std::size_t>{0, 1}));
}

// Fails if modes are merged that a careful experiment can tell apart.
TEST(Merging, LeavesDifferentRatesAlone) {
  EXPECT_EQ(in_parallel(one_mode(mode("3", "2", 0)), one_mode(mode("5", "2.000000000003", 1))).modes.size(), 2u);
}

// Fails if the cross arm of a balanced bridge, in which nothing ever moves, leaves a mode.
TEST(Merging, DropsWhatTheToolCannotSee) {
  const LinearForm form =
      form_of(R"([ { "spring": 2, "nodes": ["tool", "a"] },   { "spring": 4, "nodes": ["tool", "b"] },
                                       { "damper": 3, "nodes": ["a", "ground"] }, { "damper": 6, "nodes": ["b", "ground"] },
                                       { "spring": 7, "nodes": ["a", "b"] } ])");
  ASSERT_EQ(form.modes.size(), 1u);
  EXPECT_LT(abs(form.modes[0].stiffness - 6), rounding);
  EXPECT_LT(abs(form.modes[0].damping() - 9), rounding);
}

// Fails if two Kelvin elements of one relaxation time in series leave a mode besides their common spring and damper.
TEST(Merging, CancelsEqualRetardationTimes) {
  const LinearForm form = form_of(R"({ "series": [ { "parallel": [ { "spring": 2 }, { "damper": 1 } ] },
                                                   { "parallel": [ { "spring": 6 }, { "damper": 3 } ] } ] })");
  EXPECT_TRUE(form.modes.empty());
  EXPECT_LT(abs(form.static_stiffness - Real(3) / 2), rounding);
  EXPECT_LT(abs(form.feedthrough_damping - Real(3) / 4), rounding);
}

}  // namespace
