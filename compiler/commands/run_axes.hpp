// `dashpot run` with a network of two axes: on a board, or on the simulated device, led by a hand round the middle of
// the workspace.
#pragma once

#include <dashpot/simulated/hand.hpp>

#include "commands/commands.hpp"

namespace dashpot::compiler {

// Of `user` mass, damping and stiffness are taken, alike in all directions of the plane.
ExitStatus run_axes(const Options& options, const simulated::hand& user, const SourceFile& network,
                    const DeviceChoice& device, SourceFiles& files, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
