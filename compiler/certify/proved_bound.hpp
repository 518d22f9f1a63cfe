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

}  // namespace dashpot::compiler
