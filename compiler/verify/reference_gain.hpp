// Computes K of the encoder's step again (certify/quantisation.hpp) in other ways: the velocity estimate from the
// runtime's own estimator, the parts behind slips from their stiffness over one sample.
#pragma once

#include <optional>

#include "certify/motor_constants.hpp"
#include "certify/sampled_loop.hpp"
#include "certify/slip_motor.hpp"
#include "verify/reference_slips.hpp"
#include "verify/reference_tunables.hpp"

namespace dashpot::compiler {

// Bounds of K: the effect of one particular error of the encoder, and the largest effect of any [N/m].
struct ReferenceGain {
  Reference least, most;
};

// Of a linear law, by its constants, which have been found right. Empty where nothing is known of the estimator in it.
std::optional<ReferenceGain> reference_gain(const MotorConstants& motor, const SampledLoop& loop);

// For a law with slips or a contact; `motor`: the gain of its compensation by an estimate, which is a choice. It is not
// checked that no slip gives way within a step.
std::optional<ReferenceGain> reference_gain(const ReferenceTree& tree, const ReferenceForm& linear,
                                            const Network& network, const SlipDecomposition& slips,
                                            const SlipMotor& motor, const LawFacts& facts, const SampledLoop& loop);

// Σ|h_j| of the velocity estimate itself [1/s].
std::optional<ReferenceGain> reference_pulse(const SampledLoop& loop);

// Whether a certificate's K, or its absence, agrees with that of the compiled law, which has to lie between the bounds.
bool agrees(const std::optional<double>& stated, const std::optional<double>& compiled,
            const std::optional<ReferenceGain>& gain, ScalarType scalar);

// Whether a stated K is between, but for rounding.
bool is_within(double stated, const ReferenceGain& gain, ScalarType scalar);

}  // namespace dashpot::compiler
