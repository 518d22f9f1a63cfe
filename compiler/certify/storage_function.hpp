// A storage function of the sampled loop: a matrix P that proves the damping b enough for any motion, under jitter too
// (theory, section 6b; the inequality stands in check/check.hpp).
//
// The search works in coordinates in which every state's largest excursion, weighed by what the damping leaves over at
// that frequency, is one, and asks for M ⪰ diag(Q, 0) with Q = I/(4n): at every frequency that costs at most a quarter
// of what is left over, so there is always a P, with much room where states are slow. P is minus the stabilising
// solution of a Riccati equation, by doubling. What is found is rounded to doubles, or to two for each entry
// where one is too coarse, and then checked with integers: the search itself need not be trusted.
#pragma once

#include <cmath>
#include <optional>

#include "certify/certificate.hpp"
#include "check/check.hpp"

namespace dashpot::compiler {

// With more states a search takes seconds: the bound over frequencies is then used alone.
inline constexpr std::size_t most_storage_states = 240;

struct StorageProof {
  double damping = 0;              // b, proved [N·s/m]
  dashpot_check::Storage storage;  // P, by rows up to the diagonal
  bool in_doubles = true;          // else the search needed 50 digits
};

// The loop in the checker's form, with the coefficients of the runtime's estimator.
dashpot_check::Device checked_device(const SampledLoop& loop);

// A motor as the checker would read it from a header.
dashpot_check::Program checked_program(const MotorConstants& motor);

// Whether the length of a hold changes more than what a damping turns into heat in it: behind an amplifier's lag, and
// where the estimate divides by that length. One P has then to serve holds of all lengths.
bool needs_one_for_all_holds(const MotorConstants& motor, const SampledLoop& loop);

// At most 1e-8 above the supremum over all frequencies if doubles suffice and samples are punctual, else as little
// above it as is found; with jitter times T_max/T, and where one P must serve all holds close to what the best such P
// needs. With `most`, dampings much above that are not looked for [N·s/m]. Empty if nothing is proved.
std::optional<StorageProof> storage_proof(const MotorConstants& motor, const SampledLoop& loop, double most = HUGE_VAL);

// One P for all holds, as above. Found sooner, with up to a hundredth more damping, where that is no more than `enough`
// or that is empty.
std::optional<StorageProof> proof_for_all_holds(const MotorConstants& motor, const SampledLoop& loop,
                                                std::optional<double> enough);

// The damping of such a proof that is found soon, as doubles tell, sooner still: for a search [N·s/m].
std::optional<double> estimate_for_all_holds(const MotorConstants& motor, const SampledLoop& loop);

}  // namespace dashpot::compiler
