// reset(p): at rest at p, springs relaxed but for what p loads statically.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "closed_forms.hpp"

namespace dashpot::responses {
namespace {

constexpr double rest = 384 * unit_increment;  // [m] or [rad]

void move(Model& model, const EmittedLaw& law) {
  for (const Sample& sample : samples_of(random_motion(14, 10), law.sample_period))
    model.step(sample.position, sample.velocity);
}

// Fails if anything of the past survives a reset, even a sample that still waits for update().
TEST(Reset, LeavesNothingOfThePast) {
  for (const EmittedLaw& law : all_laws()) {
    const std::shared_ptr<Model> used = law.make(), fresh = law.make();
    move(*used, law);
    used->output(3 * rest, 1);
    used->reset(rest);
    fresh->reset(rest);
    EXPECT_EQ(used->numbers(), fresh->numbers()) << law.title();
    used->update();
    EXPECT_EQ(used->numbers(), fresh->numbers()) << law.title();
  }
}

// Fails if a network that was reset at p pushes with more than k0 p there, or drifts.
TEST(Reset, LoadsTheStaticSpringAlone) {
  for (const EmittedLaw& law : all_laws()) {
    const double k0 = ClosedForm(law).static_stiffness();
    const double expected = law.is_float() ? double(float(k0) * float(rest)) : k0 * rest;
    const std::shared_ptr<Model> model = law.make();
    model->reset(rest);
    EXPECT_NEAR(model->stored_energy(), expected * rest / 2, 1e-6 * expected * rest) << law.title();
    for (int n = 0; n < 100; ++n) ASSERT_EQ(model->step(rest, 0).force, expected) << law.title();
  }
}

// Fails if an object that was never reset is not at rest at 0.
TEST(Reset, IsNotNeededAtZero) {
  for (const EmittedLaw& law : all_laws()) {
    const std::shared_ptr<Model> fresh = law.make(), reset = law.make();
    reset->reset(0);
    EXPECT_EQ(fresh->numbers(), reset->numbers()) << law.title();
  }
}

// Fails if a NaN or infinite position, given to reset(), leaves a law that refuses every sample from then on.
TEST(Reset, AtNoNumberIsAResetAtZero) {
  for (const EmittedLaw& law : all_laws())
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      const std::shared_ptr<Model> model = law.make(), expected = law.make();
      model->reset(bad);
      expected->reset(0);
      EXPECT_EQ(model->numbers(), expected->numbers()) << law.title();
    }
}

}  // namespace
}  // namespace dashpot::responses
