// Arithmetic with subnormal numbers is tens of times slower on many processors: held still, a law must never get there.
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include "law/evaluate.hpp"
#include "emit/emission.hpp"
#include "emitted_laws.hpp"
#include "motion.hpp"

namespace dashpot::responses {
namespace {

// Says whether, since it was made, an operation took a subnormal operand (where the processor tells) or rounded a
// result down into the subnormal range.
class SubnormalWatch {
 public:
  SubnormalWatch() {
    std::feclearexcept(FE_ALL_EXCEPT);
#ifdef __SSE2__
    _mm_setcsr(_mm_getcsr() & ~denormal_operand);
#endif
  }

  bool saw_one() const {
#ifdef __SSE2__
    if ((_mm_getcsr() & denormal_operand) != 0) return true;
#endif
    return std::fetestexcept(FE_UNDERFLOW) != 0;
  }

 private:
  static constexpr unsigned denormal_operand = 0x0002;
};

// Fails if the watch is blind.
TEST(Subnormal, IsSeenByTheWatch) {
  const SubnormalWatch watch;
  volatile double number = 1e-300;
  EXPECT_FALSE(watch.saw_one());
  number = number * 1e-15;
  EXPECT_TRUE(watch.saw_one());
}

// Held for 2,000 samples one by one, then to 1.2 million: 1,200 s at 1 kHz.
constexpr int watched_closely = 2000;
constexpr int held = 1200000;
constexpr int stride = 97;  // a state that decays too slowly to be seen at once stays subnormal for longer than this

// Fails if a state that decays becomes subnormal, or anything computed of it.
TEST(Subnormal, IsNeverAStateThatDecays) {
  for (const char* variant : {"exact_1khz", "euler_nodal", "float_exact"})
    for (const EmittedLaw& law : laws_of_variant(variant)) {
      if (law.compilation().form.linear.modes.size() > 100) continue;
      const std::shared_ptr<Model> model = law.make();
      model->reset(0);
      for (const Sample& sample : samples_of(random_motion(16, 20), law.sample_period))
        model->step(sample.position, sample.velocity);
      const double position = 32 * unit_increment;
      SubnormalWatch watch;
      for (int n = 0; n < held; ++n) {
        model->step(position, 0);
        if (n > watched_closely && n % stride != 0) continue;
        if (watch.saw_one()) FAIL() << law.title() << " computes with a subnormal number at or before sample " << n;
        ASSERT_TRUE(model->keeps_only_normal_numbers()) << law.title() << ", sample " << n;
        watch = SubnormalWatch();
      }
    }
}

// Fails if the threshold is never reached, so that the test above shows nothing, or can be felt.
TEST(Subnormal, IsForestalledByExactlyZero) {
  const EmittedLaw& law = law_of("exact_1khz", "maxwell_reversal");
  const std::shared_ptr<Model> model = law.make();
  model->reset(0);
  model->step(0.125, 0);
  double last = model->step(0.125, 0).force, smallest = last;
  while (last != 0) {
    const double now = model->step(0.125, 0).force;
    ASSERT_LT(now, last);
    smallest = last;
    last = now;
  }
  EXPECT_LT(smallest, 1e-60);
}

// Fails if emitted code guards other places at a sample than `simulate` does, where guards take turns, or one of them
// never.
TEST(Subnormal, IsForestalledInTurnAsInSimulate) {
  int laws = 0;
  for (const char* variant : {"exact_1khz", "euler_nodal"})
    for (const EmittedLaw& law : laws_of_variant(variant)) {
      if (law.compilation().law.guards.empty()) continue;
      ++laws;
      const std::shared_ptr<Model> model = law.make();
      compiler::Evaluation<double> evaluated(law.compilation().law);
      model->reset(0);
      evaluated.reset(0);
      std::vector<Sample> samples = samples_of(random_motion(16, 20), law.sample_period);
      samples.resize(samples.size() + held, {});
      double last = 1;
      for (const Sample& sample : samples) {
        last = model->step(sample.position, sample.velocity).force;
        ASSERT_EQ(last, evaluated.step(sample.position, sample.velocity).force) << law.title();
      }
      EXPECT_EQ(last, 0) << law.title();
    }
  EXPECT_GT(laws, 0);
}

// Fails if a constant of any law is itself subnormal.
TEST(Subnormal, IsNoConstant) {
  for (const EmittedLaw& law : all_laws())
    for (const compiler::Coefficient& coefficient : law.compilation().law.coefficients)
      for (const double value : coefficient.values) {
        const bool is_normal = law.is_float() ? std::isnormal(float(value)) : std::isnormal(value);
        EXPECT_TRUE(value == 0 || is_normal) << law.title() << ": " << coefficient.name;
      }
}

}  // namespace
}  // namespace dashpot::responses
