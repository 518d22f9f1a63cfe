// The stated error bounds against forces in 60 digits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "compiled.hpp"
#include "law/evaluate.hpp"
#include "discretise/rounding.hpp"
#include "support/exact_oracle.hpp"
#include "support/random.hpp"

namespace {

using namespace dashpot::testing;
using namespace dashpot::compiler;

enum class Course { ramp, reversals, noise };

// Positions that a float holds exactly.
std::vector<double> positions(Course course, std::size_t samples) {
  Random random(samples);
  std::vector<double> all;
  double position = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    if (course == Course::ramp) position = static_cast<double>(i + 1) * 0x1p-14;
    if (course == Course::reversals) position = i % 2 == 0 ? 0.7109375 : -0.23828125;
    if (course == Course::noise) position = std::floor(random.uniform(-4096, 4096)) * 0x1p-12;
    all.push_back(position);
  }
  return all;
}

struct Errors {
  double worst = 0;
  double scale = 0;  // the largest force that the motion would build up if it never turned back
};

template <class Scalar>
Errors errors_over(const Compiled& compiled, const std::vector<double>& motion) {
  const Exact k(compiled->form.linear.modes.at(0).stiffness);
  const Exact x = Exact(compiled->form.linear.modes.at(0).relaxation_rate) / Exact(compiled->rate);
  const Exact a = exp(-x), c = k * (1 - a) / x;
  Evaluation<Scalar> law(compiled.law());
  law.reset();
  Exact force = 0, rectified = 0;
  double last = 0;
  Errors errors;
  for (const double position : motion) {
    force = a * force + c * (Exact(position) - last);
    rectified = a * rectified + c * std::abs(position - last);
    last = position;
    const Exact error = abs(Exact(double(law.step(static_cast<Scalar>(position), Scalar(0)).force)) - force);
    errors.worst = std::max(errors.worst, error.convert_to<double>());
    errors.scale = std::max(errors.scale, rectified.convert_to<double>());
  }
  return errors;
}

Compiled maxwell(double relaxation_rate, ScalarType scalar) {
  Choices choices;
  choices.scalar = scalar;
  choices.decomposition = "velocity-free";
  return Compiled(network_text(fmt::format(R"({{ "series": [ {{ "spring": 3.7 }}, {{ "damper": {} }} ] }})",
                                           3.7 / relaxation_rate)),
                  choices);
}

// Seen from outside the force also bears the roundings of c Δu, of the sum and of c itself.
template <class Scalar>
void expect_bounded(double relaxation_rate, ScalarType scalar, ModeForm form) {
  const Compiled compiled = maxwell(relaxation_rate, scalar);
  ASSERT_EQ(compiled.law().mode_form, form) << relaxation_rate;
  for (const Course course : {Course::ramp, Course::reversals, Course::noise}) {
    const Errors errors = errors_over<Scalar>(compiled, positions(course, 20000));
    const double allowed = (compiled.law().relative_error_bound + 4 * unit_roundoff(scalar)) * errors.scale;
    EXPECT_LE(errors.worst, allowed) << "rate " << relaxation_rate << ", course " << int(course);
  }
}

// Fails if forces in double are worse than the banner of the emitted code says, at any pace of relaxation.
TEST(Rounding, DoubleKeepsItsBound) {
  for (const double rate : {1.0, 30.0, 700.0, 5000.0})
    expect_bounded<double>(rate, ScalarType::float64, ModeForm::product);
  expect_bounded<double>(0.2, ScalarType::float64, ModeForm::delta);
  for (const double rate : {1e-3, 0.1}) expect_bounded<double>(rate, ScalarType::float64, ModeForm::compensated);
}

// Fails if forces in float are worse than the banner says.
TEST(Rounding, FloatKeepsItsBound) {
  for (const double rate : {1.0, 30.0, 700.0}) expect_bounded<float>(rate, ScalarType::float32, ModeForm::delta);
  for (const double rate : {1e-3, 0.01}) expect_bounded<float>(rate, ScalarType::float32, ModeForm::compensated);
}

// Fails if the form of the update is not the cheapest whose bound is tolerable.
TEST(Rounding, TheFormFollowsFromTheBound) {
  for (const ScalarType scalar : {ScalarType::float64, ScalarType::float32}) {
    const double tolerated = scalar == ScalarType::float64 ? 1e-12 : 1e-3;
    const ModeForm plain = scalar == ScalarType::float64 ? ModeForm::product : ModeForm::delta;
    for (double loss = 1e-9; loss < 1; loss *= 3) {
      const ModeForm form = cheapest_form(loss, scalar);
      EXPECT_EQ(form == plain, error_bound(plain, loss, unit_roundoff(scalar)) <= tolerated) << loss;
      EXPECT_LE(error_bound(form, loss, unit_roundoff(scalar)), tolerated) << loss;
    }
  }
}

// Fails if a slow relaxation freezes in float: 100 s at 10 kHz loses 1e-6 of its force a sample, less than a float
// resolves.
TEST(Rounding, SlowRelaxationsDoNotFreezeInFloat) {
  Choices choices;
  choices.scalar = ScalarType::float32;
  choices.rate = 10000;
  const Compiled compiled(network_text(R"({ "series": [ { "spring": 1 }, { "damper": 100 } ] })"), choices);
  Evaluation<float> law(compiled.law());
  law.reset();
  const double start = law.step(1, 0).force;
  double end = 0;
  for (int i = 0; i < 100000; ++i) end = law.step(1, 0).force;
  EXPECT_NEAR(end / start, std::exp(-0.1), 1e-6);
}

// Fails if a state that decays becomes subnormal, where arithmetic is many times slower.
TEST(Rounding, StatesGoToZeroBeforeTheyAreSubnormal) {
  for (const double rate : {30.0, 5000.0}) {
    const Compiled compiled = maxwell(rate, ScalarType::float64);
    Evaluation<double> law(compiled.law());
    law.reset();
    double force = law.step(1, 0).force;
    for (int i = 0; i < 30000 && force != 0; ++i) {
      force = law.step(1, 0).force;
      ASSERT_TRUE(force == 0 || std::isnormal(force)) << force;
    }
    EXPECT_EQ(force, 0);
    EXPECT_EQ(law.stored_energy(), 0);
  }
}

}  // namespace
