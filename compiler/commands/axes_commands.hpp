// What `check`, `explain`, `compile` and `simulate` ask with networks of two axes.
#pragma once

#include <optional>
#include <string>

#include "commands/commands.hpp"
#include "emit/axes_emission.hpp"
#include "stage_times.hpp"

namespace dashpot::compiler {

// False, with a diagnostic, where network and device have not as many axes.
bool as_many_axes(const SourceFile& network, const DeviceChoice& device, Diagnostics& diagnostics);

// Whether it is a network of two axes.
bool has_two_axes(const SourceFile& network);

// Everything about the network in --name and --device's terms; nothing, reported, where it is refused.
std::optional<AxesCompilation> compile_axes(const SourceFile& network, const Options& options,
                                            const DeviceChoice& device, Diagnostics& diagnostics);
std::optional<AxesCompilation> compile_axes(const SourceFile& network, const Options& options,
                                            const DeviceChoice& device, Diagnostics& diagnostics, StageTimes& times);

// What `explain` prints.
std::string explain_axes(const AxesCompilation& compilation, bool as_json, bool with_legend);

// What `compile --print` shows of a stage.
std::string axes_stage_text(const AxesCompilation& compilation, const std::string& stage);

// Of one that is not certified: that nothing is proved, with what could be, or what damping is missing.
void warn_of_uncertified(const AxesCompilation& compilation, Diagnostics& diagnostics);

// Warns of what is not certified, with what could be; true but on a device that lacks damping, which is refused unless
// --uncertified is given.
bool insist_on_certificate(const AxesCompilation& compilation, const Options& options, Diagnostics& diagnostics);

// The header. Refuses: targets and options that know no two axes, and what insist_on_certificate() refuses.
std::optional<std::vector<OutputFile>> emit_axes(const AxesCompilation& compilation, const Options& options,
                                                 Diagnostics& diagnostics);

}  // namespace dashpot::compiler
