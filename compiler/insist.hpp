// A law that is not certified on its device is not handed out by accident.
#pragma once

#include "emit/emission.hpp"

namespace dashpot::compiler {

// True where there is no device, or the law is certified on it. Warns where nothing can be proved. Refuses where
// damping is missing, with what brake, what share of the network or what rate would do.
bool insist_on_certificate(const Compilation& compilation, const Choices& choices, Diagnostics& diagnostics);

// For those who drive it all the same: warns of a law that is not certified on its device.
void warn_of_driving_uncertified(const Compilation& compilation, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
