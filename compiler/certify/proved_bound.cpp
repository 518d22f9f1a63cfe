#include "certify/proved_bound.hpp"

#include "certify/adaptive_window.hpp"
#include "certify/estimator_factors.hpp"
#include "certify/motor_limits.hpp"
#include "certify/unproved.hpp"

namespace dashpot::compiler {
namespace {

// The loop that the bound speaks of; empty where the bound is not over frequencies alone.
std::optional<SampledLoop> loop_of(const PassivityBound& bound, const std::optional<MotorConstants>& motor,
                                   const SampledLoop& loop) {
  const bool is_plain = motor && bound.proof == Proof::sampled && !bound.any_regime && !bound.any_value;
  if (!is_plain || loop.motor_slew > 0) return std::nullopt;
  SampledLoop spoken_of = loop;
  if (bound.constant_period_only) spoken_of.jitter = 0;
  return spoken_of;
}

}  // namespace

PassivityBound proved_bound(const std::optional<MotorConstants>& motor, const SampledLoop& loop) {
  PassivityBound bound = passivity_bound(motor, loop);
  const std::optional<SampledLoop> spoken_of = loop_of(bound, motor, loop);
  if (!spoken_of) return bound;
  const bool adapts = motor->follows_estimate() && adaptive_window_gain(loop);
  const bool divides = motor->follows_estimate() && divides_by_varying_interval(*spoken_of);
  std::optional<StorageProof> proof = adapts ? std::nullopt : storage_proof(*motor, *spoken_of);
  if (adapts || (divides && (!proof || proof->damping > bound.needed)))
    proof = adaptive_storage_proof(*motor, *spoken_of);
  if (!proof || proof->damping > bound.needed * (1 + most_storage_excess)) return bound;
  bound.needed = proof->damping;
  bound.storage = std::move(proof->storage);
  return bound;
}

namespace {

std::optional<StorageProof> one_for_all(const MotorConstants& motor, const SampledLoop& loop,
                                        const std::optional<Rational>& enough) {
  if (loop.motor_slew > 0) return std::nullopt;
  std::optional<StorageProof> proof = proof_for_all_holds(motor, loop);
  if (enough && (!proof || Rational(proof->damping) > *enough))
    if (std::optional<StorageProof> least = storage_proof(motor, loop)) return least;
  return proof;
}

// Of what position drives by one P, and of an estimate that is not linear by its gain, which no lag makes larger.
std::optional<StorageProof> part_by_part(const MotorConstants& motor, const SampledLoop& loop,
                                         const std::optional<Rational>& enough) {
  const std::optional<double> estimate = damping_for_estimate(motor, loop);
  std::optional<StorageProof> proof = estimate ? one_for_all(position_driven(motor), loop, enough) : std::nullopt;
  if (proof) proof->damping += *estimate * (loop.longest_hold() / loop.sample_period) * (1 + 1e-14);
  return proof;
}

}  // namespace

PassivityBound under_jitter(PassivityBound bound, const MotorConstants& motor, const SampledLoop& loop,
                            std::optional<Rational> enough) {
  if (bound.proof == Proof::none || !bound.constant_period_only || loop.jitter == 0) return bound;
  if (loop.jitter >= loop.sample_period) return not_proved(at_once);
  const bool is_linear = !motor.follows_estimate() || estimator_factors(loop);
  std::optional<StorageProof> proof = is_linear ? one_for_all(motor, loop, enough) : part_by_part(motor, loop, enough);
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

PassivityBound stated_bound(const std::optional<MotorConstants>& motor, const SampledLoop& loop,
                            const Rational& there) {
  const bool is_lifted = motor && loop.amplifier_lag > 0 && loop.jitter > 0;
  return is_lifted ? under_jitter(passivity_bound(motor, loop), *motor, loop, there) : proved_bound(motor, loop);
}

}  // namespace dashpot::compiler
