// output() gives the command, update() follows once it has left: called otherwise, they do no harm.
#include <gtest/gtest.h>

#include <limits>

#include "emitted_laws.hpp"
#include "motion.hpp"

namespace dashpot::responses::two_phases_test {
namespace {

constexpr double rest = 0;

std::vector<Sample> some_samples(const EmittedLaw& law) { return samples_of(random_motion(15, 10), law.sample_period); }

void expect_equal(const Command& one, const Command& other, const EmittedLaw& law) {
  EXPECT_EQ(one.force, other.force) << law.title();
  EXPECT_EQ(one.damping, other.damping) << law.title();
}

// Fails if step() is not output() and then update(): in commands, in stored energy, or when one follows the other.
TEST(TwoPhases, MakeAStep) {
  for (const EmittedLaw& law : all_laws()) {
    const std::shared_ptr<Model> stepped = law.make(), parted = law.make(), mixed = law.make();
    bool is_parted = false;
    for (const Sample& sample : some_samples(law)) {
      const Command expected = parted->output(sample.position, sample.velocity);
      parted->update();
      expect_equal(stepped->step(sample.position, sample.velocity), expected, law);
      expect_equal(
          is_parted ? mixed->output(sample.position, sample.velocity) : mixed->step(sample.position, sample.velocity),
          expected, law);
      mixed->update();
      is_parted = !is_parted;
      ASSERT_EQ(stepped->stored_energy(), parted->stored_energy()) << law.title();
      ASSERT_EQ(mixed->stored_energy(), parted->stored_energy()) << law.title();
    }
  }
}

// Fails if update() without a sample, before the first one or twice after one, moves any state.
TEST(TwoPhases, UpdateDoesNothingWithoutASample) {
  for (const EmittedLaw& law : all_laws()) {
    const std::shared_ptr<Model> model = law.make();
    model->reset(rest);
    const std::vector<unsigned char> fresh = model->bytes();
    model->update();
    EXPECT_EQ(model->bytes(), fresh) << law.title();
    for (const Sample& sample : some_samples(law)) model->step(sample.position, sample.velocity);
    const std::vector<unsigned char> after = model->bytes();
    model->update();
    EXPECT_EQ(model->bytes(), after) << law.title();
  }
}

// Fails if output() itself moves the law on: asked twice, it answers twice the same, and the last sample counts.
TEST(TwoPhases, OutputMayBeAskedAgain) {
  for (const EmittedLaw& law : all_laws()) {
    const std::shared_ptr<Model> once = law.make(), twice = law.make();
    for (const Sample& sample : some_samples(law)) {
      twice->output(-sample.position, 0.25);
      expect_equal(twice->output(sample.position, sample.velocity), twice->output(sample.position, sample.velocity),
                   law);
      twice->update();
      once->output(sample.position, sample.velocity);
      once->update();
      ASSERT_EQ(once->numbers(), twice->numbers()) << law.title();
    }
  }
}

// Fails if a step, of a number or of none, leaves a sample of an output() before it to the next update().
TEST(TwoPhases, AStepDropsTheSampleThatWaits) {
  for (const EmittedLaw& law : all_laws())
    for (const double position : {0.001, std::numeric_limits<double>::quiet_NaN()}) {
      const std::shared_ptr<Model> plain = law.make(), mixed = law.make();
      for (const Sample& sample : some_samples(law)) {
        plain->step(position, 0.1);
        mixed->output(sample.position, sample.velocity);
        mixed->step(position, 0.1);
        mixed->update();
        ASSERT_EQ(mixed->stored_energy(), plain->stored_energy()) << law.title();
        expect_equal(mixed->output(sample.position, sample.velocity), plain->output(sample.position, sample.velocity),
                     law);
      }
    }
}

}  // namespace
}  // namespace dashpot::responses::two_phases_test
