#include "closed_forms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace dashpot::responses {
namespace {

// Fails if a network of the repository is not among the laws under test, so that the loops below pass it over.
TEST(EmittedLaws, AreThereForEveryLinearNetwork) {
  std::set<std::string> networks;
  for (const EmittedLaw& law : laws_of_variant("exact_1khz")) networks.insert(law.network);
  for (const char* name : {"kelvin", "bridge", "generalised_kelvin_four", "heel_fat_pad", "swine_kidney_cortex",
                           "lone_spring", "lone_damper", "thousand_branches"})
    EXPECT_EQ(networks.count(name), 1u) << name;
  EXPECT_GE(networks.size(), 24u);
}

// Fails if a class says another period or kind of motion than its network and rate have.
TEST(EmittedLaws, KnowTheirPeriodAndMotion) {
  for (const EmittedLaw& law : all_laws()) {
    const double period = 1 / law.rate();
    EXPECT_EQ(law.sample_period, law.is_float() ? double(float(period)) : period) << law.title();
    EXPECT_EQ(law.is_rotary, law.network == "rotary_branches") << law.title();
  }
}

// Fails if the force during a ramp departs from f = r [k0 t + b∞ + Σ B_i (1 − e^{−λ_i t})], which is (6).
TEST(ClosedForms, FollowTheRamp) {
  for (const EmittedLaw& law : all_laws()) {
    const ClosedForm network(law);
    const double rate = 256 * unit_increment * law.rate();
    std::vector<double> expected;
    for (int n = 1; n <= 600; ++n) {
      long double force = network.static_stiffness() * n / law.rate() + network.feedthrough_damping();
      for (const auto& mode : network.modes()) force += mode.stiffness / mode.relaxation_rate * mode.loss(n);
      expected.push_back(static_cast<double>(rate * force));
    }
    expect_felt_force(law, ramp(600), expected);
  }
}

// Fails if relaxation under a held position is not the network's own.
TEST(ClosedForms, RelaxWhileHeld) {
  for (const EmittedLaw& law : all_laws()) {
    const Motion motion = ramp_and_hold(300, 700);
    expect_felt_force(law, motion, ClosedForm(law).force(motion));
  }
}

// Fails if any state is driven wrongly where the slope changes: 30 rises, falls and rests.
TEST(ClosedForms, FollowMotionsThatAreLinearBetweenKnots) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const EmittedLaw& law : all_laws()) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const Motion motion = random_motion(seed, 30);
      expect_felt_force(law, motion, ClosedForm(law).force(motion));
    }
}

// Fails if a step, which a sampled law sees as a ramp of one period, is not answered by Σ c_i a_iⁿ with
// c_i = k_i (1 − a_i)/(λ_i h), and by an impulse of the feedthrough damping in the first sample alone.
TEST(ClosedForms, AnswerTheStepWithItsDiscreteAnswer) {
  constexpr double height = 1024 * unit_increment;
  for (const EmittedLaw& law : all_laws()) {
    const ClosedForm network(law);
    std::vector<double> expected;
    for (int n = 0; n < 400; ++n) {
      long double force = network.static_stiffness();
      for (const auto& mode : network.modes()) force += mode.step_stiffness * mode.decay(n);
      if (n == 0) force += network.feedthrough_damping() * law.rate();
      expected.push_back(static_cast<double>(height * force));
    }
    expect_felt_force(law, {{1, height}, {399, 0}}, expected);
  }
}

}  // namespace
}  // namespace dashpot::responses
