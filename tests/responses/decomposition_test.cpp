// f = b u̇ + m, however the force is shared between brake and motor.
#include <gtest/gtest.h>

#include <cmath>

#include "emit/emission.hpp"
#include "emitted_laws.hpp"
#include "motion.hpp"

namespace dashpot::responses {
namespace {

const char* const candidates[] = {"exact_1khz",          "split_zero_frequency",   "split_quietest_passive",
                                  "split_velocity_free", "split_largest_observer", "split_virtual",
                                  "split_given"};

// Fails if any law, ever, asks the brake for a negative damping, or for another than its decomposition chose.
TEST(Decomposition, GivesTheBrakeWhatWasChosen) {
  for (const EmittedLaw& law : all_laws()) {
    const double chosen = law.compilation().decomposition.choice().damping;
    const double damping = law.is_float() ? double(float(chosen)) : chosen;
    const std::shared_ptr<Model> model = law.make();
    model->reset(0);
    for (const Sample& sample : samples_of(random_motion(9, 5), law.sample_period)) {
      const Command now = model->step(sample.position, sample.velocity);
      EXPECT_GE(now.damping, 0) << law.title();
      EXPECT_EQ(now.damping, damping) << law.title();
    }
  }
}

// Fails if the sum of the two parts depends on how they were parted: each rounds a few times, by its own size.
TEST(Decomposition, DoesNotChangeTheForce) {
  for (const EmittedLaw& reference : laws_of_variant("split_virtual"))
    for (const char* variant : candidates) {
      const EmittedLaw& law = law_of(variant, reference.network);
      const std::shared_ptr<Model> whole = reference.make(), parted = law.make();
      for (const Sample& sample : samples_of(random_motion(10, 40), law.sample_period)) {
        const double force = whole->step(sample.position, sample.velocity).force;
        const Command now = parted->step(sample.position, sample.velocity);
        const double size = std::abs(force) + std::abs(now.force) + now.damping * std::abs(sample.velocity);
        ASSERT_NEAR(felt_force(now, sample.velocity), force, 1e-12 * size) << law.title();
      }
    }
}

// Fails if a candidate means something else than theory, section 4, says of the paper's own model.
TEST(Decomposition, OfTheSecondOrderModelIsThePapers) {
  const auto damping_of = [](const char* variant) {
    return law_of(variant, "second_order_maxwell").make()->step(0, 0).damping;
  };
  EXPECT_EQ(damping_of("exact_1khz"), 11);
  EXPECT_EQ(damping_of("split_zero_frequency"), 11);
  EXPECT_EQ(damping_of("split_quietest_passive"), 5.5);
  EXPECT_EQ(damping_of("split_velocity_free"), 0);
  EXPECT_EQ(damping_of("split_largest_observer"), 11);
  EXPECT_EQ(damping_of("split_virtual"), 0);
  EXPECT_EQ(damping_of("split_given"), 0.625);
}

// Fails if `velocity-free` lets any estimate into the motor: its force must not depend on the velocity at all.
TEST(Decomposition, VelocityFreeNeedsNoEstimate) {
  for (const EmittedLaw& law : laws_of_variant("split_velocity_free")) {
    const std::shared_ptr<Model> one = law.make(), other = law.make();
    for (const Sample& sample : samples_of(random_motion(11, 20), law.sample_period))
      ASSERT_EQ(one->step(sample.position, sample.velocity).force, other->step(sample.position, -3).force)
          << law.title();
  }
}

}  // namespace
}  // namespace dashpot::responses
