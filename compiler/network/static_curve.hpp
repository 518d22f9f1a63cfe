// The static curve of a network file.
#pragma once

#include <optional>

#include "network/network.hpp"
#include "network/parameter_table.hpp"

namespace dashpot::compiler {

// Refuses: an unknown 'is', values that are not above zero, a power below 1, tables that do not begin at [0, 0] or do
// not rise strictly.
std::optional<StaticCurve> read_static_curve(const StaticDecl& decl, ParameterTable& values, motion port_motion,
                                             Diagnostics& diagnostics);

}  // namespace dashpot::compiler
