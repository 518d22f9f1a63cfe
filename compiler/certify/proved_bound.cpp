#include "certify/proved_bound.hpp"

#include "certify/adaptive_window.hpp"
#include "certify/motor_limits.hpp"

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

PassivityBound under_jitter(PassivityBound bound, const MotorConstants& linear, const std::optional<SlipMotor>& slips,
                            const SampledLoop& loop, const Rational& assured) {
  const bool is_open = bound.proof != Proof::none && bound.constant_period_only && loop.jitter > 0 && !bound.any_value;
  if (!is_open || Rational(bound.needed) > assured) return bound;
  std::optional<StorageProof> proof;
  if (!slips && loop.motor_slew == 0) proof = storage_proof(linear, loop, std::nullopt, assured.convert_to<double>());
  if (proof && Rational(proof->damping) <= assured) {
    bound.needed = proof->damping;
    bound.storage = std::move(proof->storage);
    bound.constant_period_only = false;
    return bound;
  }
  const std::optional<double> needed = needed_sample_by_sample(linear, slips, loop);
  // Behind a contact the brake leaves a free tool alone, which touches late.
  const Rational there = slips && slips->behind_contact ? assured_damping(loop, 0) : assured;
  if (!needed || Rational(*needed) > there) return bound;
  bound.proof = Proof::hold;
  bound.needed = *needed;
  bound.frequency = 0;
  bound.storage.reset();
  bound.constant_period_only = false;
  return bound;
}

}  // namespace dashpot::compiler
