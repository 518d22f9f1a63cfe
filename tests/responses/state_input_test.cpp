// What drives the states is a choice that no rule makes once for all (theory, section 3): two Kelvin elements under a
// sine of velocity of 0.5 Hz, the estimate 5 ms late.
#include <gtest/gtest.h>

#include <cmath>

#include "closed_forms.hpp"

namespace dashpot::responses::state_input_test {
namespace {

constexpr double angular = 3.14159265358979323846;  // [rad/s]
constexpr double lateness = 5e-3;                   // [s]
constexpr double duration = 2;                      // [s]

double velocity(double t) { return t <= 0 ? 0 : std::sin(angular * t); }
double position(double t) { return (1 - std::cos(angular * t)) / angular; }

double true_force(const ClosedForm& network, double t) {
  double force = network.static_stiffness() * position(t) + network.feedthrough_damping() * velocity(t);
  for (const auto& mode : network.modes()) {
    const double k = double(mode.stiffness), rate = double(mode.relaxation_rate);
    force += k / (rate * rate + angular * angular) *
             (rate * std::sin(angular * t) - angular * std::cos(angular * t) + angular * std::exp(-rate * t));
  }
  return force;
}

// Of the felt force, rms relative to the rms of the true force [%].
double felt_error(const std::string& variant, const std::string& network) {
  const EmittedLaw& law = law_of(variant, network);
  const ClosedForm closed_form(law);
  const std::shared_ptr<Model> model = law.make();
  model->reset(0);
  double squared_error = 0, squared_force = 0;
  for (int k = 0; k * law.sample_period <= duration; ++k) {
    const double t = k * law.sample_period, truth = true_force(closed_form, t);
    const double felt = felt_force(model->step(position(t), velocity(t - lateness)), velocity(t));
    squared_error += (felt - truth) * (felt - truth);
    squared_force += truth * truth;
  }
  return 100 * std::sqrt(squared_error / squared_force);
}

struct Errors {
  double nodal, velocity, position;  // [%]
};

Errors errors_of(const std::string& network) {
  return {felt_error("late_nodal", network), felt_error("late_velocity", network),
          felt_error("late_position", network)};
}

// Fails if the three drives are not three laws with errors of their own, or `nodal` never is the best.
TEST(StateInput, NodalIsBestForOneNetwork) {
  const Errors errors = errors_of("kelvins_for_nodal");
  EXPECT_NEAR(errors.nodal, 0.0331, 0.0001);
  EXPECT_NEAR(errors.velocity, 0.0531, 0.0001);
  EXPECT_NEAR(errors.position, 0.1444, 0.0001);
}

// Fails if `velocity` never is.
TEST(StateInput, VelocityIsBestForAnother) {
  const Errors errors = errors_of("kelvins_for_velocity");
  EXPECT_NEAR(errors.nodal, 0.0924, 0.0001);
  EXPECT_NEAR(errors.velocity, 0.0457, 0.0001);
  EXPECT_NEAR(errors.position, 0.0634, 0.0001);
}

// Fails if `position` never is.
TEST(StateInput, PositionIsBestForAThird) {
  const Errors errors = errors_of("kelvins_for_position");
  EXPECT_LT(errors.position, 0.5 * errors.nodal);
  EXPECT_LT(errors.position, 0.5 * errors.velocity);
}

}  // namespace
}  // namespace dashpot::responses::state_input_test
