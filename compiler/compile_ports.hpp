// The compiler for several ports on one axis: every port by itself on its share of the device, then one law of all.
#pragma once

#include <optional>

#include "decompose/choices.hpp"
#include "emit/emission.hpp"
#include "source/diagnostic.hpp"
#include "stage_times.hpp"

namespace dashpot::compiler {

// In: a network of ports, the user's choices, a device or none. Out: everything about it, and about each port on its
// share of brake, motor and the device's own damping; what is certified is the sum on the whole device. Refuses: what
// any stage refuses of a port; a damping as the decomposition, which would be every port's.
std::optional<Compilation> compile_ports(Network network, const Choices& choices, const std::optional<Device>& device,
                                         Diagnostics& diagnostics, StageTimes& times);

}  // namespace dashpot::compiler
