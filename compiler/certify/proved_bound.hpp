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

// For a search, behind an amplifier's lag under jitter: what is necessary, since every hold may be the longest, is soon
// known; what is proved asks for a few per cent beyond, which hardly depend on the damping. 1 where nothing is asked
// for, infinite where nothing is proved.
bool needs_jitter_gap(const SampledLoop& loop);
double jitter_gap(const MotorConstants& motor, const SampledLoop& loop);
// So many times what is necessary; of other loops passivity_bound(). Of what is beside slips, and of a law with slips,
// what certify_in_search() does with it.
PassivityBound bound_by_gap(const MotorConstants& motor, const SampledLoop& loop, double gap,
                            std::size_t terms = most_terms);
PassivityBound bound_beside_slips_by_gap(const MotorConstants& linear, const SlipMotor& slips, const SampledLoop& loop,
                                         double gap, std::size_t terms = most_terms);
Certificate weighed_by_gap(UpdateLaw& law, const SampledLoop& loop, const SlipMotor& slips, double gap);

// Both, for a law without slips that is told its brake command as it is; `there`: the damping that is assured without
// anything added [N·s/m].
PassivityBound stated_bound(const std::optional<MotorConstants>& motor, const SampledLoop& loop, const Rational& there);

}  // namespace dashpot::compiler
