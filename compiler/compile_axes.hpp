// The compiler for networks of two axes as one function: every port by the stages of one axis, then one law of all.
#pragma once

#include <optional>
#include <vector>

#include "decompose/choices.hpp"
#include "emit/axes_emission.hpp"
#include "source/diagnostic.hpp"
#include "stage_times.hpp"

namespace dashpot::compiler {

// In: a network file with "axes": 2, the user's choices, a device of two axes or none. Out: everything about it.
// Refuses: what any stage refuses. Adds to `times` what each stage took.
std::optional<AxesCompilation> compile_axes(const SourceFile& source, const Choices& choices,
                                            const std::optional<AxesDevice>& device, Diagnostics& diagnostics,
                                            StageTimes& times);

// For each brake a limit with which the network would be certified, all raised alike, in two digits; empty where
// nothing is proved, or no brake is enough.
std::optional<std::vector<double>> brakes_that_would_do(const AxesCompilation& compilation);

// Damping of the joints' own with which the network would be certified, in three digits [N·m·s/rad or N·s/m]; empty
// where nothing is proved, or no damping is enough. What the joints have of their own the brakes leave out of theirs,
// so that more may be needed than is missing.
std::optional<axes::Pair<double>> own_damping_that_would_do(const AxesCompilation& compilation);

}  // namespace dashpot::compiler
