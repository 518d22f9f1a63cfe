// Force over displacement in a steady back and forth, as the emitted code makes it.
#pragma once

#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// A linear network: one loop with the shares of brake and motor, and the closed form. One with slips or contact: three
// loops, the middle one as large as it takes for the slips to yield; a contact is touched and left.
std::string hysteresis_html(const Compilation& compilation);

}  // namespace dashpot::compiler
