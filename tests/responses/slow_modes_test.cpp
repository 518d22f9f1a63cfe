// A relaxation of 10 s at 100 kHz: a million samples, over which rounding may add up (theory, section 3, delta form).
#include <gtest/gtest.h>

#include <cmath>

#include "closed_forms.hpp"
#include "emit/emission.hpp"

namespace dashpot::responses::slow_modes_test {
namespace {

constexpr float stiffness = 16;              // [N/m]
constexpr float relaxation_rate = 0.1f;      // [1/s]
constexpr float period = 1e-5f;              // [s]
constexpr int relaxation_samples = 1000000;  // 10 s
constexpr float increment = float(unit_increment);

// What the mode answers to a ramp of one relaxation time and a hold after it [N].
double true_force(int n) {
  constexpr double x = 1e-6;  // λh
  const double plateau = double(stiffness) * double(increment) / x;
  return plateau * -std::expm1(-x * std::min(n, relaxation_samples)) *
         std::exp(-x * std::max(0, n - relaxation_samples));
}

// Largest error over the ramp and a hold of two relaxation times, relative to the peak, of a recurrence F ← next(F,
// Δu).
template <class Next>
double largest_error(Next next) {
  double largest = 0;
  float force = 0;
  for (int n = 1; n <= 3 * relaxation_samples; ++n) {
    force = next(force, n <= relaxation_samples ? increment : 0.0f);
    largest = std::max(largest, std::abs(double(force) - true_force(n)));
  }
  return largest / true_force(relaxation_samples);
}

// Fails if the trap that the delta form is for is not there: F ← a F + c Δu in float, its coefficients worked out in
// float.
TEST(SlowModes, AreRuinedByCarelessFloat) {
  const float decay = std::exp(-relaxation_rate * period);
  const float gain = stiffness * (1 - decay) / (relaxation_rate * period);
  const double error = largest_error([&](float force, float change) { return decay * force + gain * change; });
  EXPECT_GT(error, 5e-3);  // five times what the compiler tolerates in float
}

// Fails if the delta form alone would do, so that compensation were waste.
TEST(SlowModes, AreWithinAThousandthByTheDeltaForm) {
  const float loss = float(-std::expm1(-1e-6)), gain = float(double(stiffness) * -std::expm1(-1e-6) / 1e-6);
  const double error = largest_error([&](float force, float change) { return force + (gain * change - loss * force); });
  EXPECT_GT(error, 1e-5);
  EXPECT_LT(error, 1e-2);
}

double emitted_error(const EmittedLaw& law) {
  const Motion motion = {{relaxation_samples, unit_increment}, {2 * relaxation_samples, 0}};
  const std::vector<double> expected = ClosedForm(law).force(motion);
  const double peak = expected[relaxation_samples - 1];
  const std::shared_ptr<Model> model = law.make();
  model->reset(0);
  double largest = 0, position = 0;
  for (std::size_t n = 0; n < expected.size(); ++n) {
    // At velocity 0 and with the brake's part left out, the motor's force is the mode's own.
    position += n < relaxation_samples ? unit_increment : 0;
    largest = std::max(largest, std::abs(model->step(position, 0).force - expected[n]) / peak);
  }
  return largest;
}

// Fails if an emitted law departs from its mode's own force by more than the bound that its banner states: the mode's,
// and one roundoff for each of the two operations that make the command of it.
TEST(SlowModes, KeepToTheStatedBound) {
  for (const char* variant : {"slow_double", "slow_float", "slow_float_euler"}) {
    const EmittedLaw& law = law_of(variant, "ten_seconds");
    const double roundoff = law.is_float() ? 0x1p-24 : 0x1p-53;
    const double bound = law.compilation().law.relative_error_bound;
    EXPECT_LE(bound, law.is_float() ? 2e-6 : 1e-12) << law.title();
    EXPECT_LE(emitted_error(law), bound + 2 * roundoff) << law.title();
  }
}

}  // namespace
}  // namespace dashpot::responses::slow_modes_test
