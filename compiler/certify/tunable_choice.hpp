// `faithful` for a network whose parameters change while it runs.
#pragma once

#include "certify/certificate.hpp"
#include "linear/normal_form.hpp"

namespace dashpot::compiler {

// In: a decomposition whose candidate `faithful` is settled at the default values. That damping, b∞, which follows the
// parameters and needs no estimate, and some between 0 and b∞ are weighed by what is felt at the default values with
// what the certificate over the whole range of the parameters adds. Ensures: the candidate has the one that
// faithful_rule.hpp takes, after the way from it to the next larger one has been halved three times.
void choose_over_box(const Network& network, const NormalForm& form, Decomposition& decomposition,
                     const Choices& choices, const PortDevice& port, double rate);

// Whether the chosen damping and state input are certified over the whole range of the parameters.
bool is_certified_over_box(const Network& network, const NormalForm& form, const Decomposition& decomposition,
                           const Choices& choices, const PortDevice& port, double rate);

}  // namespace dashpot::compiler
