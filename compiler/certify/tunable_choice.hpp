// `faithful` for a network whose parameters change while it runs.
#pragma once

#include "certify/certificate.hpp"
#include "linear/normal_form.hpp"

namespace dashpot::compiler {

// In: a network, the same at its default values, and a decomposition whose candidate `faithful` is settled there.
// Compares that damping; b∞, which follows the parameters and needs no estimate; and some values between 0 and b∞: by
// the error at the default values of what is felt with the damping that the certificate over the whole range of the
// parameters adds. Ensures: the candidate has the damping that faithful_rule.hpp takes, after the distance from it to
// the next larger one has been halved three times. A network whose parameters do not change keeps what is settled.
void choose_over_box(const Network& network, const Network& present, const NormalForm& form,
                     Decomposition& decomposition, const Choices& choices, const PortDevice& port, double rate);

// Whether the chosen damping and state input are certified over the whole range of the parameters; true where none
// changes.
bool is_certified_over_box(const Network& network, const Network& present, const NormalForm& form,
                           const Decomposition& decomposition, const Choices& choices, const PortDevice& port,
                           double rate);

}  // namespace dashpot::compiler
