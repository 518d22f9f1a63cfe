// The compiler as one function: every stage in order.
#pragma once

#include <optional>

#include "decompose/choices.hpp"
#include "emit/emission.hpp"
#include "source/diagnostic.hpp"
#include "stage_times.hpp"

namespace dashpot::compiler {

// In: a network file's text, the user's choices, a device or none. Out: everything about it. Refuses: what any stage
// refuses; all that can be found is reported.
std::optional<Compilation> compile(const SourceFile& source, const Choices& choices,
                                   const std::optional<Device>& device, Diagnostics& diagnostics);

// Of a network that is read already.
std::optional<Compilation> compile(Network network, const Choices& choices, const std::optional<Device>& device,
                                   Diagnostics& diagnostics, StageTimes& times);

// The same as the first, and what each stage takes.
std::optional<Compilation> compile(const SourceFile& source, const Choices& choices,
                                   const std::optional<Device>& device, Diagnostics& diagnostics, StageTimes& times);

// What the sampled loop needs of every candidate, not only of the chosen one: for those who look at them.
void weigh_all_candidates(Compilation& compilation, const Choices& choices);

// The front end alone: errors and warnings about the file. Springpots that state no band take the device's.
std::optional<Network> check(const SourceFile& source, Diagnostics& diagnostics,
                             const std::optional<Device>& device = std::nullopt);

}  // namespace dashpot::compiler
