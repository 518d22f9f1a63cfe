// What is stated of a linear law: the damping that a storage function proves (theory, section 6b), where one is found.
//
// The bound over frequencies serves searches, and what is no linear law. It is rigorous too, but a slow mode may cost
// it a hundredth, and who wants to check it has to repeat it.
#pragma once

#include "certify/certificate.hpp"
#include "certify/storage_function.hpp"

namespace dashpot::compiler {

// Relative; above it a storage function is not taken in place of the bound over frequencies.
inline constexpr double most_storage_excess = 1e-8;

// `passivity_bound`, but where it is one over frequencies and nothing stands beside it, the damping that a storage
// function proves, with its P; behind an amplifier's lag for punctual samples.
PassivityBound proved_bound(const std::optional<MotorConstants>& motor, const SampledLoop& loop);

// Of a bound that is proved for punctual samples alone, behind an amplifier's lag, what is under the device's jitter:
// by one P for holds of all lengths, or sample by sample. By a P that is found soon where `enough` [N·s/m] is empty or
// covers it, else by the best that is found. Other bounds as they are; not proved where nothing is.
PassivityBound under_jitter(PassivityBound bound, const MotorConstants& motor, const SampledLoop& loop,
                            std::optional<Rational> enough);

// Both, for a law without slips that is told its brake command as it is; `there`: the damping that is assured without
// anything added [N·s/m].
PassivityBound stated_bound(const std::optional<MotorConstants>& motor, const SampledLoop& loop, const Rational& there);

}  // namespace dashpot::compiler
