// The bound stated for a linear law: the damping that a storage function proves (theory, section 6b), if one is found.
//
// The bound over frequencies is used by searches, and for laws that are not linear. It is rigorous too, but with a slow
// mode it may be a hundredth too large, and it can only be checked by repeating the computation.
#pragma once

#include "certify/certificate.hpp"
#include "certify/storage_function.hpp"

namespace dashpot::compiler {

// If a storage function needs more than this in excess (relative), the bound over frequencies is used instead.
inline constexpr double most_storage_excess = 1e-8;

// `passivity_bound`, but where it is one over frequencies and nothing stands beside it, the damping that a storage
// function proves, with its P; behind an amplifier's lag for punctual samples.
PassivityBound proved_bound(const std::optional<MotorConstants>& motor, const SampledLoop& loop);

// For a bound that is proved for punctual samples only, behind an amplifier's lag: the bound under the device's jitter,
// by one P for holds of all lengths, or sample by sample. If `enough` [N·s/m] is empty or covers it, a P that is found
// quickly is used, else the best that is found. Other bounds are returned as they are; not proved if nothing is.
PassivityBound under_jitter(PassivityBound bound, const MotorConstants& motor, const SampledLoop& loop,
                            std::optional<Rational> enough);

// For a search, behind an amplifier's lag under jitter. The damping that is necessary, since every hold may be the
// longest, is quickly known; the damping that is proved is larger by a factor, the gap, of a few per cent that hardly
// depends on the brake's damping. The gap is 1 if nothing is needed, infinite if nothing is proved.
bool needs_jitter_gap(const SampledLoop& loop);
double jitter_gap(const MotorConstants& motor, const SampledLoop& loop);
// The necessary damping times `gap`; for other loops passivity_bound(). The same for what is beside slips; and for a
// law with slips, what certify_in_search() finds with it.
PassivityBound bound_by_gap(const MotorConstants& motor, const SampledLoop& loop, double gap,
                            std::size_t terms = most_terms);
PassivityBound bound_beside_slips_by_gap(const MotorConstants& linear, const SlipMotor& slips, const SampledLoop& loop,
                                         double gap, std::size_t terms = most_terms);
Certificate weighed_by_gap(UpdateLaw& law, const SampledLoop& loop, const SlipMotor& slips, double gap);

// proved_bound(), then under_jitter(), for a law without slips whose brake gets its command unchanged; `there`: the
// damping that is assured without any addition [N·s/m].
PassivityBound stated_bound(const std::optional<MotorConstants>& motor, const SampledLoop& loop, const Rational& there);

// The stiffest spring that is certified by itself, with the brake at its largest damping [N/m]: what a spring needs is
// proportional to its stiffness. Without lag and jitter that is 2 b/(T (1 + 2 n)). Nothing without a device, or where
// nothing is proved of a spring.
std::optional<double> stiffest_spring(const SampledLoop& loop);

}  // namespace dashpot::compiler
