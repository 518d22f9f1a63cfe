#include "certify/certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dashpot/estimators/estimator_names.hpp>
#include <limits>

#include "certify/hold_bound.hpp"
#include "certify/quantisation.hpp"

namespace dashpot::compiler {
namespace {

// Why the hold certificate does not cover the motor; empty where it does.
std::string hindrance_to_hold(const MotorConstants& motor, const SampledLoop& loop) {
  if (motor.estimate_drives_modes()) return "the velocity estimate drives the states";
  if (motor.follows_estimate()) return "the motor follows the velocity estimate";
  if (loop.delay_samples > 0) return "the loop is late by whole samples";
  if (loop.amplifier_lag > 0) return "the amplifier lags";
  return "";
}

// The bounds of two parts of a motor add up.
PassivityBound sampled_statement(const MotorConstants& motor, const SampledLoop& loop, const EstimatorFactors& estimator,
                                 double besides) {
  const SampledBound found = sampled_bound(NeededDamping(motor, loop, estimator), loop.sample_period);
  PassivityBound bound;
  bound.proof = Proof::sampled;
  bound.needed = found.needed + besides;
  bound.frequency = found.frequency;
  bound.reason = hindrance_to_hold(motor, loop);
  return bound;
}

std::string not_proved_for(const SampledLoop& loop) {
  return fmt::format("nothing is proved for the estimator {} in the motor", name_of(loop.velocity.estimator));
}

double nearest(double value, ScalarType scalar) {
  return scalar == ScalarType::float64 ? value : static_cast<double>(static_cast<float>(value));
}

// The least number of the scalar's type that is not below the sum.
double sum_above(double x, double y, ScalarType scalar) {
  const Rational exact = Rational(x) + Rational(y);
  if (scalar == ScalarType::float64) return ceiling(exact);
  float nearest = static_cast<float>(x + y);
  while (Rational(nearest) < exact) nearest = std::nextafter(nearest, std::numeric_limits<float>::infinity());
  return static_cast<double>(nearest);
}

}  // namespace

PassivityBound passivity_bound(const std::optional<MotorConstants>& motor, const SampledLoop& loop) {
  PassivityBound bound;
  if (!motor) {
    bound.reason = "the law of a network with slips, contact or tunable parameters is not one linear law";
    return bound;
  }
  if (hindrance_to_hold(*motor, loop).empty()) {
    bound.proof = Proof::hold;
    bound.needed = ceiling(hold_stiffness(*motor) * (Rational(loop.sample_period) + Rational(loop.jitter)));
    return bound;
  }
  if (!motor->follows_estimate()) return sampled_statement(*motor, loop, {}, 0);
  if (const auto linear = estimator_factors(loop)) return sampled_statement(*motor, loop, *linear, 0);
  const std::optional<double> gain = adaptive_window_gain(loop);
  if (!gain || motor->estimate_drives_modes()) {
    bound.reason = not_proved_for(loop);
    return bound;
  }
  MotorConstants position_driven = *motor;
  position_driven.velocity_gain = 0;
  return sampled_statement(position_driven, loop, {}, std::abs(motor->velocity_gain) * *gain * (1 + 1e-15));
}

double missing_damping(const PassivityBound& bound, const SampledLoop& loop, double brake) {
  const Rational lacking = Rational(bound.needed) - assured_damping(loop, brake);
  if (lacking <= 0) return 0;
  const Rational share = assured_share(loop);
  return share > 0 ? ceiling(lacking / share) : std::numeric_limits<double>::infinity();
}

std::string_view name_of(Proof proof) {
  switch (proof) {
    case Proof::none: return "none";
    case Proof::hold: return "hold";
    case Proof::sampled: return "sampled";
  }
  return "";
}

double brake_command(const PassivityBound& bound, const SampledLoop& loop, double damping, ScalarType scalar) {
  const double alone = nearest(damping, scalar);
  if (!loop.has_device || bound.proof == Proof::none) return alone;
  const double missing = missing_damping(bound, loop, alone);
  if (missing == 0 || !std::isfinite(missing)) return alone;
  const double together = sum_above(alone, missing, scalar);
  return together <= loop.max_damping ? together : alone;
}

double unpaid_force(const Certificate& certificate) {
  const double most = certificate.quantisation_gain.value_or(0) * certificate.loop.encoder_step / 2;
  return std::max(most - certificate.loop.coulomb_friction, 0.0);
}

Certificate certify(UpdateLaw& law, const SampledLoop& loop) {
  const std::optional<MotorConstants> motor = motor_constants(law);
  Certificate result;
  result.loop = loop;
  result.bound = passivity_bound(motor, loop);
  if (result.bound.proof != Proof::none) {
    result.minimum_damping = missing_damping(result.bound, loop, law.damping);
    const double alone = law.damping;
    law.damping = law.largest_damping = brake_command(result.bound, loop, alone, law.scalar);
    result.added_damping = nearest(law.damping - alone, law.scalar);
  }
  const Rational assured = assured_damping(loop, law.damping);
  result.assured = assured.convert_to<double>();
  result.certified = result.bound.proof != Proof::none && assured >= Rational(result.bound.needed);
  if (motor) result.energy = check_energy_lemma(*motor);
  if (motor) result.quantisation_gain = quantisation_gain(*motor, loop);
  if (loop.encoder_step > 0) result.quantisation_stiffness = 2 * loop.coulomb_friction / loop.encoder_step;
  return result;
}

}  // namespace dashpot::compiler
