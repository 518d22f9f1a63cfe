// Between samples the exact scheme sees straight lines: a sine is met to the second order of the step.
#include <gtest/gtest.h>

#include <cmath>

#include "closed_forms.hpp"

namespace dashpot::responses {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double angular = 2 * pi * 2;  // [rad/s]
constexpr double amplitude = 1e-2;      // [m] or [rad]
constexpr double duration = 0.5;        // [s]

// f(t) from rest under u = A sin ωt: the sinusoid of D(jω) and each mode's transient, e^{−λt}.
double closed_form(const ClosedForm& network, double t) {
  double force = network.static_stiffness() * amplitude * std::sin(angular * t) +
                 network.feedthrough_damping() * amplitude * angular * std::cos(angular * t);
  for (const auto& mode : network.modes()) {
    const double k = double(mode.stiffness), rate = double(mode.relaxation_rate);
    force += k * amplitude * angular / (rate * rate + angular * angular) *
             (angular * std::sin(angular * t) + rate * std::cos(angular * t) - rate * std::exp(-rate * t));
  }
  return force;
}

// Largest, relative to the largest force.
double error_of(const std::string& variant, const std::string& name) {
  const EmittedLaw& law = law_of(variant, name);
  const ClosedForm network(law);
  const double rate = law.rate();
  const std::shared_ptr<Model> model = law.make();
  model->reset(0);
  double largest = 0, off = 0;
  for (int n = 1; n <= duration * rate; ++n) {
    const double t = n / rate, velocity = amplitude * angular * std::cos(angular * t);
    const double felt = felt_force(model->step(amplitude * std::sin(angular * t), velocity), velocity);
    largest = std::max(largest, std::abs(felt));
    off = std::max(off, std::abs(felt - closed_form(network, t)));
  }
  return off / largest;
}

// Fails if the error under a sine does not fall as the square of the step; where a network has no modes there is none.
TEST(Sine, IsMetToTheSecondOrder) {
  for (const EmittedLaw& law : laws_of_variant("exact_8khz")) {
    const double coarse = error_of("exact_8khz", law.network), middle = error_of("exact_16khz", law.network);
    const double fine = error_of("exact_32khz", law.network);
    if (ClosedForm(law).modes().empty()) {
      EXPECT_LE(coarse, 1e-12) << law.network;
      continue;
    }
    EXPECT_NEAR(std::log2(coarse / middle), 2, 0.05) << law.network;
    EXPECT_NEAR(std::log2(middle / fine), 2, 0.05) << law.network;
  }
}

}  // namespace
}  // namespace dashpot::responses
