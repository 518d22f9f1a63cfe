// From a network with tunable parameters to the tables of its law.
#pragma once

#include <optional>

#include "decompose/brake_rule.hpp"
#include "decompose/choices.hpp"
#include "decompose/decomposition.hpp"
#include "law/tunable_tables.hpp"

namespace dashpot::compiler {

// In: a network with tunables; its linear part and its canonical form at the default values, the decomposition chosen
// for it. Out: its tables. Ensures: parts that no tunable touches are reduced to modes, Maxwell branches keep the
// chosen scheme, other parts with tunables keep element states by backward Euler. Refuses: more states, slips, … than
// there is room for; more slips outside a tree than are compiled there without tunables.
std::optional<TunableTables> tunable_tables_of(const Network& linear, const Network& network,
                                               const Decomposition& decomposition, const Choices& choices,
                                               const Real& sample_period, const PortDevice& device,
                                               Diagnostics& diagnostics);

}  // namespace dashpot::compiler
