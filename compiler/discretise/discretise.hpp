// From a decomposed network to its update law.
#pragma once

#include <optional>

#include "decompose/decomposition.hpp"
#include "decompose/port_device.hpp"
#include "law/update_law.hpp"
#include "linear/normal_form.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

// In: normal form, decomposition of its linear part, scheme, rate, scalar. Out: the law. Ensures: constants rounded
// once from extended precision.
UpdateLaw discretise(const Network& network, const NormalForm& form, const Decomposition& decomposition,
                     const Choices& choices, double rate);

// Warns: a relaxation faster than two samples; a float that cannot carry stiffest and slowest mode together.
void warn_about_rate_and_scalar(const Network& network, const NormalForm& form, const Decomposition& decomposition,
                                const Choices& choices, double rate, Diagnostics& diagnostics);

// The same for a network with tunables; `present`, form and decomposition are those of its default values. Refuses:
// what tunable_tables_of() refuses.
std::optional<UpdateLaw> discretise_tunable(const Network& network, const Network& present, const NormalForm& form,
                                            const Decomposition& decomposition, const Choices& choices, double rate,
                                            const PortDevice& device, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
