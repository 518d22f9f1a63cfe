// From the text of network and device files of two axes to what their author wrote (architecture, section 7).
#pragma once

#include <optional>

#include "source/diagnostic.hpp"
#include "syntax/axes_decl.hpp"

namespace dashpot::compiler {

inline constexpr std::size_t most_axes = 2;

// What the key "axes" of a network or device file says; 1 where there is none, and where the file is none.
std::size_t axes_of(const SourceFile& file);

// In: a file with "axes": 2. Out: its declaration. Refuses: as parse_network() and parse_device() do.
std::optional<AxesNetworkDecl> parse_axes_network(const SourceFile& file, Diagnostics& diagnostics);
std::optional<AxesDeviceDecl> parse_axes_device(const SourceFile& file, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
