// The discrete tissue is a tissue (theory, section 6): it never gives back more than was put in.
#include <gtest/gtest.h>

#include <cmath>

#include "emitted_laws.hpp"
#include "motion.hpp"
#include "support/random.hpp"

namespace dashpot::responses {
namespace {

// Rises, falls, rests, and shaking at the period itself.
std::vector<Sample> shaken(std::uint64_t seed, double period) {
  testing::Random random(seed);
  std::vector<Sample> samples = samples_of(random_motion(seed, 40), period);
  double last = 0;
  for (Sample& sample : samples) {
    if (random.chance(0.5)) sample.position += (double(random.between(0, 4000)) - 2000) * unit_increment;
    sample.velocity = (sample.position - last) / period;
    last = sample.position;
  }
  return samples;
}

// Each of the two energies, the work and the force's own sum round a few times.
double rounding_of(const EmittedLaw& law, double energies_and_work) {
  return 32 * (law.is_float() ? 0x1p-24 : 0x1p-53) * energies_and_work;
}

// Fails if a position driven law releases energy that it did not take: V_k − V_{k−1} ≤ f_k Δu_k at every sample, for
// both schemes and any motion.
TEST(EnergyLemma, HoldsForPositionDrivenLaws) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const EmittedLaw& law : all_laws()) {
      if (law.state_input() != compiler::StateInput::position) continue;
      const std::shared_ptr<Model> model = law.make();
      model->reset(0);
      double before = model->stored_energy(), last = 0;
      for (const Sample& sample : shaken(seed, law.sample_period)) {
        const double force = felt_force(model->step(sample.position, sample.velocity), sample.velocity);
        const double work = force * (sample.position - last), after = model->stored_energy();
        const double size = before + after + std::abs(force) * std::abs(sample.position - last);
        ASSERT_LE(after - before, work + rounding_of(law, size)) << law.title() << ", seed " << seed;
        before = after;
        last = sample.position;
      }
    }
}

// Fails if stored_energy() is not ½ k0 u² + Σ F_i²/2k_i: a ramp slow enough loads the spring alone, a step loads all.
TEST(EnergyLemma, StoredEnergyIsThatOfTheSprings) {
  const std::shared_ptr<Model> model = law_of("exact_1khz", "second_order_maxwell").make();
  model->reset(0.25);
  EXPECT_EQ(model->stored_energy(), 0.5 * 5 * 0.25 * 0.25);
  model->reset(0);
  model->step(0.5, 500);
  const auto energy_of = [](double k, double rate) {
    const double x = rate * 1e-3, force = k * -std::expm1(-x) / x * 0.5;
    return force * force / (2 * k);
  };
  EXPECT_NEAR(model->stored_energy(), 0.5 * 5 * 0.25 + energy_of(12, 12.0 / 5) + energy_of(10, 10.0 / 6), 1e-12);
}

// Fails if energy is counted below zero or if a law that is shaken and left alone keeps what its dampers should eat.
TEST(EnergyLemma, LeavesTheStaticSpringAloneInTheEnd) {
  const EmittedLaw& law = law_of("exact_1khz", "second_order_maxwell");
  const std::shared_ptr<Model> model = law.make();
  model->reset(0);
  for (const Sample& sample : shaken(4, law.sample_period)) {
    model->step(sample.position, sample.velocity);
    ASSERT_GE(model->stored_energy(), 0);
  }
  for (int n = 0; n < 40000; ++n) model->step(0.125, 0);
  EXPECT_NEAR(model->stored_energy(), 0.5 * 5 * 0.125 * 0.125, 1e-15);
}

}  // namespace
}  // namespace dashpot::responses
