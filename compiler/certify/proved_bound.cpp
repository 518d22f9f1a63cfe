#include "certify/proved_bound.hpp"

#include <algorithm>
#include <cmath>

#include "certify/adaptive_window.hpp"
#include "certify/estimator_factors.hpp"
#include "certify/motor_limits.hpp"
#include "certify/unproved.hpp"

namespace dashpot::compiler {
namespace {

// The loop that the bound is for; empty if the bound does not come from frequencies alone.
std::optional<SampledLoop> loop_of(const PassivityBound& bound, const std::optional<MotorConstants>& motor,
                                   const SampledLoop& loop) {
  const bool is_plain = motor && bound.proof == Proof::sampled && !bound.any_regime && !bound.any_value;
  if (!is_plain || loop.motor_slew > 0) return std::nullopt;
  return bound.constant_period_only ? punctual(loop) : loop;
}

}  // namespace

PassivityBound proved_bound(const std::optional<MotorConstants>& motor, const SampledLoop& loop) {
  PassivityBound bound = passivity_bound(motor, loop);
  const std::optional<SampledLoop> spoken_of = loop_of(bound, motor, loop);
  if (!spoken_of) return bound;
  const bool adapts = motor->follows_estimate() && adaptive_window_gain(loop);
  const bool divides = motor->follows_estimate() && divides_by_varying_interval(*spoken_of);
  const double most = bound.needed * (1 + most_storage_excess);
  std::optional<StorageProof> proof = adapts ? std::nullopt : storage_proof(*motor, *spoken_of, most);
  if (adapts || (divides && (!proof || proof->damping > bound.needed)))
    proof = adaptive_storage_proof(*motor, *spoken_of);
  if (!proof || proof->damping > most) return bound;
  bound.needed = proof->damping;
  bound.storage = std::move(proof->storage);
  return bound;
}

namespace {

bool is_one_linear_loop(const MotorConstants& motor, const SampledLoop& loop) {
  return !motor.follows_estimate() || estimator_factors(loop);
}

// Damping that an estimate which is not linear needs in addition: its gain, which no lag makes larger [N·s/m].
std::optional<double> needed_beside(const MotorConstants& motor, const SampledLoop& loop) {
  if (is_one_linear_loop(motor, loop)) return 0;
  const std::optional<double> estimate = damping_for_estimate(motor, loop);
  if (!estimate) return std::nullopt;
  return *estimate * (loop.longest_hold() / loop.sample_period) * (1 + 1e-14);
}

}  // namespace

PassivityBound under_jitter(PassivityBound bound, const MotorConstants& motor, const SampledLoop& loop,
                            std::optional<Rational> enough) {
  if (bound.proof == Proof::none || !bound.constant_period_only || loop.is_punctual()) return bound;
  if (loop.jitter >= loop.sample_period) return not_proved(at_once);
  const bool is_linear = is_one_linear_loop(motor, loop);
  const std::optional<double> beside = needed_beside(motor, loop);
  std::optional<StorageProof> proof;
  if (beside && loop.motor_slew == 0)
    proof = proof_for_all_holds(is_linear ? motor : position_driven(motor), loop,
                                enough ? std::optional(enough->convert_to<double>() - *beside) : std::nullopt);
  if (proof && *beside > 0) proof->damping = std::nextafter(proof->damping + *beside, HUGE_VAL);
  const std::optional<double> by_sample = needed_sample_by_sample(motor, std::nullopt, loop);
  if (!proof && !by_sample) return not_proved("the amplifier lags, and nothing is proved of it under the jitter");
  bound.constant_period_only = false;
  if (proof && (!by_sample || proof->damping <= *by_sample)) {
    bound.needed = proof->damping;
    bound.storage = is_linear ? std::optional(std::move(proof->storage)) : std::nullopt;
    return bound;
  }
  bound.proof = Proof::hold;
  bound.needed = *by_sample;
  bound.frequency = 0;
  bound.storage.reset();
  return bound;
}

bool needs_jitter_gap(const SampledLoop& loop) { return loop.amplifier_lag > 0 && !loop.is_punctual(); }

namespace {

// The law sees increments and no times, so that a longer hold is like one of a slower loop. The force that a velocity
// gain makes of a displacement stays the same, unless the estimate divides by the actual length of the hold.
PassivityBound bound_at_longest_holds(MotorConstants motor, SampledLoop loop, std::size_t terms) {
  const double longer = loop.longest_hold() / loop.sample_period;
  const bool is_measured = loop.has_device && loop.velocity.estimator == estimator_kind::interval_difference;
  motor.velocity_gain *= is_measured ? 1 : longer;
  for (MotorMode& mode : motor.modes) mode.velocity_drive *= is_measured ? 1 : longer;
  loop.velocity.cutoff /= longer;
  loop.velocity.acceleration /= longer * longer;
  loop.sample_period = loop.longest_hold();
  return passivity_bound(motor, punctual(loop), terms);
}

}  // namespace

PassivityBound bound_by_gap(const MotorConstants& motor, const SampledLoop& loop, double gap, std::size_t terms) {
  if (!needs_jitter_gap(loop)) return passivity_bound(motor, loop, terms);
  if (!std::isfinite(gap)) return not_proved("the amplifier lags, and nothing is proved of it under the jitter");
  PassivityBound bound = bound_at_longest_holds(motor, loop, terms);
  bound.constant_period_only = false;
  bound.needed *= gap;
  return bound;
}

PassivityBound bound_beside_slips_by_gap(const MotorConstants& linear, const SlipMotor& slips, const SampledLoop& loop,
                                         double gap, std::size_t terms) {
  const bool is_there = !motor_beside(slips, linear).is_idle();
  return is_there ? bound_by_gap(linear, loop, gap, terms) : bound_beside_slips(linear, slips, loop, terms);
}

double jitter_gap(const MotorConstants& motor, const SampledLoop& loop) {
  if (!needs_jitter_gap(loop)) return 1;
  const PassivityBound necessary = bound_at_longest_holds(motor, loop, most_terms / 10);
  if (necessary.proof == Proof::none) return 1;
  const std::optional<double> beside = needed_beside(motor, loop);
  const std::optional<double> one_for_all =
      beside ? estimate_for_all_holds(is_one_linear_loop(motor, loop) ? motor : position_driven(motor), loop)
             : std::nullopt;
  const std::optional<double> by_sample = needed_sample_by_sample(motor, std::nullopt, loop);
  const double needed = std::min(one_for_all ? *one_for_all + *beside : HUGE_VAL, by_sample ? *by_sample : HUGE_VAL);
  if (!std::isfinite(needed)) return HUGE_VAL;
  return necessary.needed > 0 ? std::max(needed / necessary.needed, 1.0) : 1;
}

PassivityBound stated_bound(const std::optional<MotorConstants>& motor, const SampledLoop& loop,
                            const Rational& there) {
  const bool is_lifted = motor && needs_jitter_gap(loop);
  return is_lifted ? under_jitter(passivity_bound(motor, loop), *motor, loop, there) : proved_bound(motor, loop);
}

std::optional<double> stiffest_spring(const SampledLoop& loop) {
  if (!loop.has_device) return std::nullopt;
  MotorConstants spring;
  spring.static_stiffness = 1, spring.half_static_stiffness = 0.5;
  const Rational there = assured_damping(loop, Rational(loop.max_damping));
  const PassivityBound bound = stated_bound(spring, loop, there);
  if (bound.proof == Proof::none || bound.needed <= 0) return std::nullopt;
  return there.convert_to<double>() / bound.needed;
}

}  // namespace dashpot::compiler
