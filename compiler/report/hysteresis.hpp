// Force over displacement in a steady back and forth, as the emitted code makes it.
#pragma once

#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// How far a motion has to go before the network shows what it is: until its slips yield; without slips as far as it is
// said to be valid, or as a tissue is pressed [m] or [rad].
double telling_amplitude(const Compilation& compilation);

// A linear network: one loop with the shares of brake and motor, and the closed form. One with slips or contact: three
// loops, the middle one of the amplitude given; a contact is touched and left.
std::string hysteresis_html(const Compilation& compilation, double amplitude);

}  // namespace dashpot::compiler
