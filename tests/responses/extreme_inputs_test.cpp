// step() is total: whatever comes in, a command that can be given comes out, and the states survive.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "emitted_laws.hpp"
#include "motion.hpp"
#include "support/random.hpp"

namespace dashpot::responses {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();

void move(Model& model, const EmittedLaw& law, std::uint64_t seed, int segments) {
  for (const Sample& sample : samples_of(random_motion(seed, segments), law.sample_period))
    model.step(sample.position, sample.velocity);
}

// Fails if a NaN or infinite sample changes a single bit of the states, moves the motor or lets go of the brake.
TEST(ExtremeInputs, NonFiniteSamplesChangeNoState) {
  for (const EmittedLaw& law : all_laws()) {
    const std::shared_ptr<Model> model = law.make();
    model->reset(0);
    move(*model, law, 12, 10);
    const double damping = model->step(0, 0).damping;
    const std::vector<unsigned char> before = model->bytes();
    for (const double bad : {nan, -nan, infinity, -infinity})
      for (const Command& now : {model->step(bad, 0.1), model->step(0.1, bad), model->step(bad, bad)}) {
        EXPECT_EQ(now.force, 0) << law.title();
        EXPECT_EQ(now.damping, damping) << law.title();
      }
    EXPECT_EQ(model->bytes(), before) << law.title();
  }
}

bool all_finite(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
}

// Fails if numbers near the largest ones, alternating, at random, or held, leave an infinity or a NaN in a state, after
// which every command would be refused for ever.
TEST(ExtremeInputs, OfAnySizeDoNotPoisonTheStates) {
  for (const EmittedLaw& law : all_laws()) {
    const double huge = law.is_float() ? 1e30 : 1e300,
                 most = law.is_float() ? double(std::numeric_limits<float>::max()) : largest;
    testing::Random random(13);
    const std::shared_ptr<Model> model = law.make();
    model->reset(0);
    for (int n = 0; n < 400; ++n) {
      const double size = n < 200 ? huge : most;
      const double position = n % 4 == 0 ? size : n % 4 == 1 ? -size : random.uniform(-1, 1) * size;
      const Command now = model->step(position, n % 3 == 0 ? 0 : random.uniform(-1, 1) * size);
      ASSERT_TRUE(std::isfinite(now.force)) << law.title();
      ASSERT_TRUE(all_finite(model->numbers())) << law.title() << ", sample " << n;
    }
    for (int n = 0; n < 10; ++n) model->step(0, 0);
    EXPECT_EQ(model->step(0, 0).damping, law.make()->step(0, 0).damping) << law.title();
  }
}

// Fails if one glitch of the encoder outlives the relaxation that it set off.
TEST(ExtremeInputs, AreForgottenAsFastAsTheNetworkRelaxes) {
  const std::shared_ptr<Model> struck = law_of("exact_1khz", "second_order_maxwell").make();
  struck->reset(0);
  struck->step(1e300, 0);
  struck->step(0, 0);
  EXPECT_GT(std::abs(struck->step(0, 0).force), 1e290);
  // 1e300 falls below 1e-60 in 829 relaxation times, the slower of which is 0.6 s.
  for (int n = 0; n < 500000; ++n) struck->step(0, 0);
  EXPECT_EQ(struck->step(0, 0).force, 0);
  EXPECT_EQ(struck->step(0.5, 0).force, law_of("exact_1khz", "second_order_maxwell").make()->step(0.5, 0).force);
}

}  // namespace
}  // namespace dashpot::responses
