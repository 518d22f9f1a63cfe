// A part with slips without the dampers in parallel with a slip: what the gated law computes, while the brake makes the
// force of those dampers (theory, section 5, (21)).
#pragma once

#include <optional>
#include <vector>

#include "decompose/regimes.hpp"
#include "linear/normal_form.hpp"

namespace dashpot::compiler {

// If damped slips are in series, only the weakest loses its damper: the others would never slide without theirs. Empty
// if no damper lies beside a slip.
std::optional<NormalTree> without_dampers_beside_slips(NormalTree component);

// The same for a part that is no tree, given by its elements: drops the dampers that join the ends of a slip.
std::optional<std::vector<std::size_t>> without_dampers_beside_slips(const Network& network,
                                                                     const std::vector<std::size_t>& elements);

// D(s) at the tool of a component that does not slide all through where `slides` says which of `slips` do; nothing
// where a constant force is left.
LinearForm form_in_regime(const NormalTree& component, const std::vector<SlipElements>& slips,
                          const std::vector<bool>& slides);

}  // namespace dashpot::compiler
