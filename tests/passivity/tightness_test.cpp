// The minimum damping is needed: with nine tenths of it some passive hand makes the loop grow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <dashpot/estimators/any_estimator.hpp>

#include <Eigen/Dense>

#include "certified_loop.hpp"
#include "support/repetitions.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;
using Complex = std::complex<double>;

// Arm and hand in one: m ü + b u̇ + k u = −f, where f follows what is held over a period through the amplifier's lag,
// τ ḟ = c − f. A spring and a mass are a passive hand.
struct Plant {
  double mass;
  double damping;
  double stiffness;
  double lag;
};

// What position, velocity, force and the held command of one sample leave of themselves at the next.
using Step = Eigen::Matrix4d;

// The matrix exponential of the motion over a period, by squaring a Taylor series of a 2⁻¹² of it. Without lag the
// force is the command.
Step exact_step(const Plant& plant, double period) {
  Step rates = Step::Zero();
  rates(0, 1) = 1;
  rates(1, 0) = -plant.stiffness / plant.mass;
  rates(1, 1) = -plant.damping / plant.mass;
  rates(1, plant.lag > 0 ? 2 : 3) = -1 / plant.mass;
  if (plant.lag > 0) rates(2, 2) = -1 / plant.lag, rates(2, 3) = 1 / plant.lag;
  Step power = Step::Identity(), sum = Step::Identity();
  for (int n = 1; n <= 12; ++n) sum += power = power * rates * (period / 4096 / n);
  for (int n = 0; n < 12; ++n) sum = sum * sum;
  return sum;
}

// From held command to position sample, at z; the command opposes, so that the loop is 1 + H P.
Complex plant_response(const Plant& plant, double period, Complex z) {
  const Step step = exact_step(plant, period);
  const Eigen::Matrix3cd matrix = z * Eigen::Matrix3cd::Identity() - step.topLeftCorner<3, 3>().cast<Complex>();
  return -matrix.partialPivLu().solve(step.topRightCorner<3, 1>().cast<Complex>())(0);
}

Complex polynomial(const double* coefficients, unsigned order, Complex w) {
  Complex sum = 0;
  for (unsigned i = order + 1; i-- > 0;) sum = sum * w + coefficients[i];
  return sum;
}

Complex motor_response(const MotorConstants& motor, const SampledLoop& loop, Complex z) {
  const Complex w = 1.0 / z;
  Complex position = motor.step_stiffness, velocity = motor.velocity_gain;
  for (const MotorMode& mode : motor.modes) {
    position += mode.position_drive * w / (1.0 - mode.decay * w);
    velocity += mode.velocity_drive * w / (1.0 - mode.decay * w);
  }
  Complex estimate = 0;
  if (motor.follows_estimate()) {
    const any_estimator<double> estimator(loop.velocity, loop.sample_period, loop.joint_encoder_step);
    const auto transfer = estimator.transfer();
    estimate = polynomial(transfer.numerator, transfer.numerator_order, w) /
               polynomial(transfer.denominator, transfer.denominator_order, w);
  }
  return std::pow(w, int(loop.delay_samples)) * (motor.static_stiffness + (1.0 - w) * position + estimate * velocity);
}

// Whether the loop has a root outside the unit circle near `angle`: H + 1/P = 0, by Newton's method. A run
// would take millions of samples to show it.
bool has_growing_root(const MotorConstants& motor, const SampledLoop& loop, const Plant& plant, double angle) {
  const auto residue = [&](Complex z) {
    return motor_response(motor, loop, z) + 1.0 / plant_response(plant, loop.sample_period, z);
  };
  Complex z = std::polar(1.0, angle), change = 1;
  for (int i = 0; i < 40 && std::abs(change) > 1e-13; ++i) {
    const Complex here = residue(z), step = 1e-6 * (z - 1.0);
    change = here * 2.0 * step / (residue(z + step) - residue(z - step));
    if (!(std::abs(change) < angle)) return false;
    z -= change;
  }
  const bool is_root = std::abs(residue(z) / motor_response(motor, loop, z)) < 1e-6;
  return is_root && std::arg(z) > angle / 2 && std::abs(z) - 1 > 1e-11;
}

// The damping and spring with which the loop just oscillates at `angle` for ever, by Newton's method on
// H + 1/P = 0, which is nearly linear in both.
std::optional<Plant> marginal(const Complex& motor, double period, double angle, const Plant& guess) {
  const Complex z = std::polar(1.0, angle);
  const auto residue = [&](double b, double k) {
    return motor + 1.0 / plant_response({guess.mass, b, k, guess.lag}, period, z);
  };
  double b = guess.damping, k = guess.stiffness;
  for (int i = 0; i < 40; ++i) {
    const double db = 1e-6 * b, dk = 1e-6 * (std::abs(k) + 1e-3 * guess.mass / (period * period));
    const Complex r = residue(b, k), rb = (residue(b + db, k) - r) / db, rk = (residue(b, k + dk) - r) / dk;
    const double det = rb.real() * rk.imag() - rb.imag() * rk.real();
    if (det == 0) return std::nullopt;
    b -= (r.real() * rk.imag() - r.imag() * rk.real()) / det;
    k -= (rb.real() * r.imag() - rb.imag() * r.real()) / det;
    if (!(b > 0) || !std::isfinite(k)) return std::nullopt;
  }
  if (k < 0 || std::abs(residue(b, k) / motor) > 1e-8) return std::nullopt;
  return Plant{guess.mass, b, k, guess.lag};
}

// Where hands are tuned to: at and around the angle that binds; where that is rest, at slow ones that a run has time
// for.
std::vector<double> angles_around(const Certificate& certificate) {
  const double pi = 3.14159265358979323846;
  const double bound = 2 * pi * certificate.bound.frequency * certificate.loop.sample_period;
  const double binding = certificate.bound.proof == Proof::hold ? pi : bound;
  std::vector<double> angles;
  for (const double detune : {1.0, 0.999, 0.97, 0.9, 0.75, 1.03, 1.1, 1.3})
    if (binding > 0.002 && binding * detune <= pi) angles.push_back(binding * detune);
  if (binding < 0.02) angles.insert(angles.end(), {0.06, 0.02, 0.007, 0.003, 0.001, 3e-4, 1e-4});
  return angles;
}

// From heavy to light against the damping over a period; and those that swing at the angle on the motor's own
// stiffness, with little or no spring in the hand.
std::vector<double> masses(double damped, double swinging) {
  std::vector<double> all;
  if (swinging > 0)
    for (const double times : {1.0001, 1.01, 1.2, 3.0}) all.push_back(times * swinging);
  for (const double share : {1e-4, 0.003, 0.02, 0.1, 0.5, 3.0, 30.0, 300.0}) all.push_back(damped / share);
  return all;
}

// A hand that makes the loop grow while the tool's physical damping is `damping`.
bool some_hand_destabilises(const CompiledCase& one, double damping) {
  const Certificate& certificate = one.compilation->certificate;
  const MotorConstants motor = motor_constants(one.compilation->law).value();
  const double period = certificate.loop.sample_period, lag = certificate.loop.amplifier_lag;
  for (const double angle : angles_around(certificate)) {
    const Complex H = motor_response(motor, certificate.loop, std::polar(1.0, angle));
    const Complex needed = (1.0 - std::polar(1.0, -angle)) * H * period / std::norm(1.0 - std::polar(1.0, -angle));
    for (const double mass : masses(damping * period, needed.imag() * period / angle)) {
      const double tuned = mass * angle * angle / (period * period) - needed.imag() * angle / period;
      const Plant guess{mass, certificate.bound.needed, std::max(tuned, 0.0), lag};
      const std::optional<Plant> edge = marginal(H, period, angle, guess);
      const double stiffness = edge ? edge->stiffness : 0;
      if (edge && has_growing_root(motor, certificate.loop, {mass, damping, stiffness, lag}, angle)) return true;
      if (has_growing_root(motor, certificate.loop, {mass, damping, 0, lag}, angle)) return true;
    }
  }
  return false;
}

// Linear laws and estimators whose minimum is more than a hundredth of b, with delays and amplifier lags.
int loops() { return int(repetitions(50, 200)); }

// How many of them some hand destabilises with a share of the minimum.
int destabilised_with(double share) {
  int eligible = 0, destabilised = 0;
  for (std::uint64_t seed = 1; eligible < loops(); ++seed) {
    CompiledCase one = random_case(seed);
    if (!one.compilation) continue;
    Certificate& certificate = one.compilation->certificate;
    certificate.loop.jitter = certificate.loop.write_earliest = certificate.loop.write_latest = 0;
    const std::optional<MotorConstants> motor = motor_constants(one.compilation->law);
    if (!motor || certificate.loop.velocity.estimator == estimator_kind::foaw) continue;
    certificate.bound = passivity_bound(motor, certificate.loop);
    const double b = one.compilation->decomposition.choice().damping;
    const double minimum = missing_damping(certificate.bound, certificate.loop, b);
    if (!(minimum > 0.01 * b) || !std::isfinite(minimum)) continue;
    ++eligible;
    const Rational brake = Rational(b) + Rational(share * minimum);
    destabilised += some_hand_destabilises(one, assured_damping(certificate.loop, brake).convert_to<double>()) ? 1 : 0;
  }
  return destabilised;
}

// If this failed, the certificate would ask for damping that no passive hand makes necessary.
TEST(Tightness, NineTenthsOfTheMinimumAreTooLittle) { EXPECT_GE(destabilised_with(0.9), loops() * 9 / 10); }

// If this failed, the hands above would be none, or what they do a mistake of the test: with the minimum, and a
// thousandth of it, no hand makes a loop grow.
TEST(Tightness, TheMinimumIsEnough) { EXPECT_EQ(destabilised_with(1.001), 0); }

}  // namespace
}  // namespace dashpot::testing
