// What every constant of a linear law must be, recomputed in 100 digits from the network: theory, section 3, written
// down once more, apart from discretise/.
#pragma once

#include <map>
#include <string>

#include "decompose/choices.hpp"
#include "verify/reference_form.hpp"

namespace dashpot::compiler {

struct LawFacts {
  double rate = 0;  // [Hz]
  Scheme scheme = Scheme::exact;
  ScalarType scalar = ScalarType::float64;
  StateInput state_input = StateInput::position;
  double damping = 0;  // b, as the decomposition has it [N·s/m]
};

struct ModeFactors {
  Reference decay;  // a
  Reference loss;   // 1 − a
  Reference gain;   // c
};
ModeFactors mode_factors(const ReferenceMode& mode, const LawFacts& facts);

// 1/(2 k a²); a mode that vanishes within a sample stores nothing from one to the next.
Reference energy_weight(const ReferenceMode& mode, const ModeFactors& factors, ScalarType scalar);

// How stiff it is to a step within one sample: k0 + b∞/T + Σ c [N/m].
Reference companion(const ReferenceForm& form, const LawFacts& facts);

// Each kind of constant, by the ending of its emitted name: one value, or one for each mode by ascending relaxation
// rate. Constants that a law of this kind does not have are absent.
std::map<std::string, std::vector<Reference>> reference_constants(const ReferenceForm& form, const LawFacts& facts);

// Whether no number of the scalar's type is nearer; of two between which the exact value is halfway, but for what
// rounding in 50 digits makes, either will do. Magnitudes that the law takes for zero must be zero.
bool is_correctly_rounded(double value, const Reference& exact, ScalarType scalar);

}  // namespace dashpot::compiler
