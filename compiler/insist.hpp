// A law that is not certified on its device is not handed out by accident.
#pragma once

#include "emit/emission.hpp"

namespace dashpot::compiler {

// Warns of a law that is not certified, on a device or an ideal one, with the damping that is missing, and with what
// the device would have to be like.
void warn_of_uncertified(const Compilation& compilation, const Choices& choices, Diagnostics& diagnostics);

// True where the law is certified, and, with that warning, where nothing can be proved or there is no device. Refuses
// where a device lacks damping, with what brake, what share of the network or what rate would do.
bool insist_on_certificate(const Compilation& compilation, const Choices& choices, Diagnostics& diagnostics);

// Warns where what is felt on the device errs by more than the tolerance and other choices have been tried that err
// noticeably less, with the options that say so.
void warn_of_felt_error(const Compilation& compilation, const Choices& choices, Diagnostics& diagnostics);

// Where a certified law may do more than its motor's limit allows and nothing is proved of that: tells of a choice or
// of a device that has been tried and is proved there too.
void tell_what_is_proved_at_the_limit(const Compilation& compilation, const Choices& choices, Diagnostics& diagnostics);

// For those who drive it all the same: warns of a law that is not certified on its device.
void warn_of_driving_uncertified(const Compilation& compilation, const Choices& choices, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
