#include "certify/proved_bound.hpp"

namespace dashpot::compiler {
namespace {

// The loop that the bound speaks of; empty where the bound is not over frequencies alone.
std::optional<SampledLoop> loop_of(const PassivityBound& bound, const std::optional<MotorConstants>& motor,
                                   const SampledLoop& loop) {
  const bool is_plain = motor && bound.proof == Proof::sampled && !bound.any_regime && !bound.any_value;
  if (!is_plain || loop.motor_slew > 0 || (motor->follows_estimate() && !estimator_factors(loop))) return std::nullopt;
  SampledLoop spoken_of = loop;
  if (bound.constant_period_only) spoken_of.jitter = 0;
  return spoken_of;
}

}  // namespace

PassivityBound proved_bound(const std::optional<MotorConstants>& motor, const SampledLoop& loop) {
  PassivityBound bound = passivity_bound(motor, loop);
  const std::optional<SampledLoop> spoken_of = loop_of(bound, motor, loop);
  if (!spoken_of) return bound;
  std::optional<StorageProof> proof = storage_proof(*motor, *spoken_of);
  if (!proof || proof->damping > bound.needed * (1 + most_storage_excess)) return bound;
  bound.needed = proof->damping;
  bound.storage = std::move(proof->storage);
  return bound;
}

}  // namespace dashpot::compiler
