// The bound over all frequencies against scans of the condition as it is written down, with H(z) itself.
#include <gtest/gtest.h>

#include <complex>
#include <dashpot/estimators/any_estimator.hpp>

#include "motors.hpp"
#include "support/random.hpp"

namespace dashpot::compiler {
namespace {

using dashpot::testing::Random;
using Complex = std::complex<long double>;
constexpr long double pi = 3.14159265358979323846264338327950288L;

Complex expanded(const double* coefficients, unsigned order, Complex w) {
  Complex sum = 0;
  for (unsigned i = order + 1; i-- > 0;) sum = sum * w + Complex(coefficients[i]);
  return sum;
}

// E(z), from the published pulse transfer function.
Complex estimator_response(const SampledLoop& loop, Complex w) {
  if (!loop.has_device) return (Complex(1) - w) / Complex(loop.sample_period);
  const any_estimator<double> estimator(loop.velocity, loop.sample_period, loop.joint_encoder_step);
  const auto transfer = estimator.transfer();
  return expanded(transfer.numerator, transfer.numerator_order, w) /
         expanded(transfer.denominator, transfer.denominator_order, w);
}

Complex motor_response(const MotorConstants& motor, const SampledLoop& loop, Complex w, Complex delta) {
  Complex from_position = motor.step_stiffness, from_velocity = motor.velocity_gain;
  for (const MotorMode& mode : motor.modes) {
    const Complex memory = w / (Complex(mode.loss) + Complex(mode.decay) * delta);
    from_position += Complex(mode.position_drive) * memory;
    from_velocity += Complex(mode.velocity_drive) * memory;
  }
  const Complex estimate = motor.follows_estimate() ? estimator_response(loop, w) : Complex(0);
  return std::pow(w, int(loop.delay_samples)) *
         (Complex(motor.static_stiffness) + delta * from_position + estimate * from_velocity);
}

// The eigenvalue of the form over the aliases ω_m, summed until their tail, |m| > M, is below 1e-9 of the sum; without
// lag Colgate & Schenkel's condition.
double needed_at(const MotorConstants& motor, const SampledLoop& loop, long double angle) {
  const long double sine = std::sin(angle / 2);
  const Complex w = std::polar(1.0L, -angle), delta = Complex(0, 2 * sine) * std::polar(1.0L, -angle / 2);
  const Complex H = motor_response(motor, loop, w, delta);
  const long double T = loop.sample_period, lag = loop.amplifier_lag;
  if (lag == 0) return double(T / 2 * (delta * H).real() / (2 * sine * sine));
  Complex cross = 0;
  long double squares = 0;
  for (int m = -3000; m <= 3000; ++m) {
    const long double omega = (angle + 2 * pi * m) / T;
    const Complex amplifier = Complex(1) / Complex(1, omega * lag);
    cross += amplifier / (omega * omega);
    squares += std::norm(amplifier) / (omega * omega);
  }
  const Complex product = delta * H * cross / T;
  const long double both = std::norm(delta * H) * squares / T * T / std::norm(delta);
  return double((product.real() + std::sqrt(both - product.imag() * product.imag())) / 2);
}

double largest_by_scan(const MotorConstants& motor, const SampledLoop& loop, int points) {
  std::vector<long double> angles = {1e-9L, pi};
  for (int i = 0; i <= points; ++i) angles.push_back(pi * std::pow(10.0L, -10.0L * i / points));
  for (int i = 1; i <= points; ++i) angles.push_back(pi * i / points);
  for (const MotorMode& mode : motor.modes) angles.push_back(std::min<long double>(pi, -std::log1p(-mode.loss)));
  long double best = angles[0];
  double largest = needed_at(motor, loop, best);
  for (const long double angle : angles)
    if (const double here = needed_at(motor, loop, angle); here > largest) largest = here, best = angle;
  for (long double step = best / 100; step > 1e-12L * best; step *= 0.7L)
    for (const long double angle : {best - step, std::min(best + step, pi)})
      if (const double here = needed_at(motor, loop, angle); here > largest) largest = here, best = angle;
  return largest;
}

MotorConstants random_motor(Random& random, double period) {
  MotorConstants motor = spring_motor(random.chance(0.3) ? 0 : random.log_uniform(1e-2, 1e4));
  if (random.chance(0.7)) motor.velocity_gain = (random.chance(0.5) ? -1 : 1) * random.log_uniform(1e-3, 10);
  const std::size_t modes = random.between(0, 6);
  for (std::size_t i = 0; i < modes; ++i)
    add_maxwell(motor, random.log_uniform(1e-2, 1e4), random.log_uniform(1e-5, 10) / period, period,
                random.chance(0.6));
  return motor;
}

SampledLoop random_loop(Random& random) {
  SampledLoop loop = plain_loop(random.log_uniform(1e-4, 5e-3));
  loop.has_device = true;
  loop.delay_samples = random.chance(0.5) ? 0 : unsigned(random.between(1, 4));
  loop.joint_encoder_step = 1e-5;
  const estimator_kind kinds[] = {estimator_kind::backward_difference, estimator_kind::least_squares,
                                  estimator_kind::butterworth, estimator_kind::kalman};
  loop.velocity.estimator = kinds[random.index(4)];
  loop.velocity.window = unsigned(random.between(1, 30));
  loop.velocity.order = random.chance(0.5) ? 2 : 4;
  loop.velocity.cutoff = random.uniform(0.01, 0.4) / loop.sample_period;
  loop.velocity.acceleration = random.log_uniform(0.1, 100);
  return loop;
}

// If this failed, the certificate would promise less damping than some frequency needs, or ask for more than any does.
TEST(SampledBound, MeetsAScanOnRandomMotors) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const SampledLoop loop = random_loop(random);
    const MotorConstants motor = random_motor(random, loop.sample_period);
    const SampledBound bound = bound_of(motor, loop);
    const double scanned = largest_by_scan(motor, loop, 400);
    const double scale = NeededDamping(motor, loop, estimator_factors(loop).value()).scale();
    EXPECT_GE(bound.needed, scanned - 1e-10 * scale);
    EXPECT_LE(bound.needed, std::max(scanned, 0.0) * (1 + 1e-6) + 1e-10 * scale);
    EXPECT_LT(bound.arcs, 5000u);
  }
}

// If this failed, the amplifier's lag would be left out, or its aliases would.
TEST(SampledBound, MeetsAScanWithALag) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed + 1000);
    SampledLoop loop = random_loop(random);
    loop.amplifier_lag = loop.sample_period * random.log_uniform(0.05, 20);
    const MotorConstants motor = random_motor(random, loop.sample_period);
    const SampledBound bound = bound_of(motor, loop);
    const double scanned = largest_by_scan(motor, loop, 300);
    const double scale = NeededDamping(motor, loop, estimator_factors(loop).value()).scale();
    EXPECT_GE(bound.needed, scanned - 1e-7 * scale);
    EXPECT_LE(bound.needed, std::max(scanned, 0.0) * (1 + 1e-3) + 1e-7 * scale);
  }
}

// If this failed, a supremum that is all but level, near the rounding of its terms, would be looked for without end;
// or, left early, the bound would fall below it.
TEST(SampledBound, EndsAboveANearlyLevelSupremum) {
  for (const double rate : {22.0, 2200.0, 2.2e5}) {
    SCOPED_TRACE(rate);
    const SampledLoop loop = plain_loop(1e-9);
    MotorConstants motor = spring_motor(0);
    add_maxwell(motor, 22, rate, loop.sample_period, true);
    const NeededDamping needed(motor, loop, {});
    const SampledBound bound = sampled_bound(needed, loop.sample_period),
                       sooner = sampled_bound(needed, loop.sample_period, 100);
    EXPECT_LE(bound.arcs, most_terms / needed.terms() + 2);
    EXPECT_LE(sooner.arcs, 100 / needed.terms() + 2);
    EXPECT_GE(sooner.needed, bound.needed);
    EXPECT_GE(bound.needed, bound.attained);
    EXPECT_GE(bound.needed, largest_by_scan(motor, loop, 400) - 1e-10 * needed.scale());
  }
}

}  // namespace
}  // namespace dashpot::compiler
