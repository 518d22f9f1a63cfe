// A law that is not certified on its device is not handed out by accident.
#pragma once

#include "emit/emission.hpp"

namespace dashpot::compiler {

// Warns of a law that is not certified, on a device or an ideal one, naming the damping that is missing, and what a
// device would need to have.
void warn_of_uncertified(const Compilation& compilation, const Choices& choices, Diagnostics& diagnostics);

// True if the law is certified, and, with that warning, if nothing can be proved or there is no device. Refuses a law
// whose device lacks damping, naming a brake, a share of the network or a rate that would be enough.
bool insist_on_certificate(const Compilation& compilation, const Choices& choices, Diagnostics& diagnostics);

// Warns where what is felt on the device errs by more than the tolerance and other choices have been tried that err
// noticeably less, with the options that say so.
void warn_of_felt_error(const Compilation& compilation, const Choices& choices, Diagnostics& diagnostics);

// If a certified law may require more than its motor's limit allows, and nothing is proved for that: names a choice or
// a device that has been tried and for which it is proved.
void tell_what_is_proved_at_the_limit(const Compilation& compilation, const Choices& choices, Diagnostics& diagnostics);

// For those who drive it all the same: warns of a law that is not certified on its device.
void warn_of_driving_uncertified(const Compilation& compilation, const Choices& choices, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
