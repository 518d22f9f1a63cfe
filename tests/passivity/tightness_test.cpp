// The minimum damping is needed: with nine tenths of it some passive hand makes the loop grow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/estimators/frequency_response.hpp>
#include <deque>

#include "certified_loop.hpp"
#include "discretise/evaluate.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;
using Complex = std::complex<double>;

// Arm and hand in one: m ü + b u̇ + k u = −f, f held over a period. A spring and a mass are a passive hand.
struct Plant {
  double mass;
  double damping;
  double stiffness;
};

struct PlantStep {
  double to_position[3], to_velocity[3];  // of position, velocity and held force
};

// The matrix exponential of the motion over a period, by squaring a Taylor series of a 2⁻¹² of it.
PlantStep exact_step(const Plant& plant, double period) {
  const double h = period / 4096, rates[3][3] = {{0, h, 0}, {-plant.stiffness / plant.mass * h, -plant.damping / plant.mass * h, -h / plant.mass}, {0, 0, 0}};
  double power[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, sum[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto multiply = [](const double (&x)[3][3], const double (&y)[3][3], double scale, double (&out)[3][3]) {
    double product[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) product[i][j] = scale * (x[i][0] * y[0][j] + x[i][1] * y[1][j] + x[i][2] * y[2][j]);
    std::copy(&product[0][0], &product[0][0] + 9, &out[0][0]);
  };
  for (int n = 1; n <= 12; ++n) {
    multiply(power, rates, 1.0 / n, power);
    for (int i = 0; i < 9; ++i) (&sum[0][0])[i] += (&power[0][0])[i];
  }
  for (int n = 0; n < 12; ++n) multiply(sum, sum, 1, sum);
  return {{sum[0][0], sum[0][1], sum[0][2]}, {sum[1][0], sum[1][1], sum[1][2]}};
}

// From held force to position sample, at z.
Complex plant_response(const Plant& plant, double period, Complex z) {
  const PlantStep s = exact_step(plant, period);
  const Complex a = z - s.to_position[0], d = z - s.to_velocity[1];
  return (d * s.to_position[2] + s.to_position[1] * s.to_velocity[2]) / (a * d - s.to_position[1] * s.to_velocity[0]);
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
    estimate = detail::at_angle(transfer.numerator, transfer.numerator_order, std::arg(z)) /
               detail::at_angle(transfer.denominator, transfer.denominator_order, std::arg(z));
  }
  return std::pow(w, int(loop.delay_samples)) * (motor.static_stiffness + (1.0 - w) * position + estimate * velocity);
}

// Whether the loop grows from a small displacement.
bool grows(const CompiledCase& one, const Plant& plant) {
  const SampledLoop& loop = one.compilation->certificate.loop;
  const PlantStep step = exact_step(plant, loop.sample_period);
  any_estimator<double> estimator(loop.velocity, loop.sample_period, loop.joint_encoder_step);
  Evaluation<double> law(one.compilation->law);
  law.reset(0);
  estimator.reset(0);
  std::deque<double> line(loop.delay_samples, 0.0);
  constexpr int samples = 60000;
  double u = 1e-3, v = 0, early = 0, late = 0;
  for (int k = 0; k < samples && std::abs(u) < 1e6; ++k) {
    device_sample sample;
    sample.position = u;
    line.push_back(law.step(u, estimator.update(sample)).force);
    const double force = line.front(), before = u;
    line.pop_front();
    u = step.to_position[0] * before + step.to_position[1] * v + step.to_position[2] * force;
    v = step.to_velocity[0] * before + step.to_velocity[1] * v + step.to_velocity[2] * force;
    if (k >= samples / 5 && k < 2 * samples / 5) early = std::max(early, std::abs(u));
    if (k >= 4 * samples / 5) late = std::max(late, std::abs(u));
  }
  return std::abs(u) >= 1e6 || late > early;
}

// The damping and spring with which the loop just oscillates at `angle` for ever, by Newton's method on 1 + H P = 0.
std::optional<Plant> marginal(const Complex& motor, double period, double angle, double mass, Plant guess) {
  const Complex z = std::polar(1.0, angle);
  const auto residue = [&](double b, double k) { return 1.0 / motor + plant_response({mass, b, k}, period, z); };
  double b = guess.damping, k = guess.stiffness;
  for (int i = 0; i < 40; ++i) {
    const double db = 1e-6 * b, dk = 1e-6 * (std::abs(k) + 1e-3 * mass / (period * period));
    const Complex r = residue(b, k), rb = (residue(b + db, k) - r) / db, rk = (residue(b, k + dk) - r) / dk;
    const double det = rb.real() * rk.imag() - rb.imag() * rk.real();
    if (det == 0) return std::nullopt;
    b -= (r.real() * rk.imag() - r.imag() * rk.real()) / det;
    k -= (rb.real() * r.imag() - rb.imag() * r.real()) / det;
    if (!(b > 0) || !std::isfinite(k)) return std::nullopt;
  }
  if (k < 0 || std::abs(residue(b, k) * motor) > 1e-8) return std::nullopt;
  return Plant{mass, b, k};
}

// A hand that makes the loop grow while the tool's physical damping is `damping`.
bool some_hand_destabilises(const CompiledCase& one, double damping) {
  const Certificate& certificate = one.compilation->certificate;
  const MotorConstants motor = motor_constants(one.compilation->law).value();
  const double period = certificate.loop.sample_period;
  const double binding = std::max(2 * 3.14159265358979 * certificate.bound.frequency * period, 1e-6);
  const double around = certificate.bound.proof == Proof::hold ? 3.14159265358979 : binding;
  for (const double share : {1e-4, 0.003, 0.02, 0.1, 0.5, 3.0, 30.0, 300.0})
    for (const double detune : {1.0, 0.999, 0.97, 0.9, 0.75}) {
      const double angle = around * detune, mass = damping * period / share, omega = angle / period;
      const Complex H = motor_response(motor, certificate.loop, std::polar(1.0, angle));
      const Complex needed = (1.0 - std::polar(1.0, -angle)) * H * period / std::norm(1.0 - std::polar(1.0, -angle));
      const Plant guess{mass, certificate.bound.needed, std::max(mass * omega * omega - needed.imag() * omega, 0.0)};
      const std::optional<Plant> edge = marginal(H, period, angle, mass, guess);
      if (edge && edge->damping > damping && grows(one, {mass, damping, edge->stiffness})) return true;
      if (share >= 0.5 && grows(one, {mass, damping, 0})) return true;
    }
  return false;
}

// The certificate would ask for damping that no passive hand makes necessary. Linear laws without lag, where the bound
// is met by linear hands, whose minimum is more than a hundredth of b.
TEST(Tightness, NineTenthsOfTheMinimumAreTooLittle) {
  int eligible = 0, destabilised = 0;
  for (std::uint64_t seed = 1; eligible < 30; ++seed) {
    Random random(seed);
    CompiledCase one = random_case(seed);
    if (!one.compilation) continue;
    Certificate& certificate = one.compilation->certificate;
    certificate.loop.jitter = 0;
    if (certificate.bound.proof == Proof::none || certificate.loop.amplifier_lag > 0) continue;
    if (certificate.loop.velocity.estimator == estimator_kind::foaw) continue;
    certificate.bound = passivity_bound(motor_constants(one.compilation->law), certificate.loop);
    const double b = one.compilation->decomposition.choice().damping;
    const double minimum = missing_damping(certificate.bound, certificate.loop, b);
    if (!(minimum > 0.01 * b) || !std::isfinite(minimum)) continue;
    ++eligible;
    const double damping = assured_damping(certificate.loop, Rational(b) + Rational(0.9 * minimum)).convert_to<double>();
    destabilised += some_hand_destabilises(one, damping) ? 1 : 0;
  }
  EXPECT_GE(destabilised, 27);
}

}  // namespace
}  // namespace dashpot::testing
