// The key `motion` of network and device files.
#pragma once

#include <dashpot/command.hpp>

#include <optional>

#include "source/diagnostic.hpp"
#include "syntax/network_decl.hpp"

namespace dashpot::compiler {

// Translation where absent. Reports words other than translation and rotation, and goes on with what was probably
// meant.
motion read_motion(const std::optional<Text>& text, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
