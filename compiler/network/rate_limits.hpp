// The rates that a loop may have, whoever states one: a device file, a command line, a certificate, a motion.
#pragma once

namespace dashpot::compiler {

inline constexpr double lowest_rate = 1e-6;  // [Hz]
inline constexpr double highest_rate = 1e9;  // [Hz], beyond any loop: a period stays a normal number in float

}  // namespace dashpot::compiler
