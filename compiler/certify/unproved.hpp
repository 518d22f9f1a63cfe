// Cases in which nothing is proved, and why.
#pragma once

#include <string>

#include "certify/certificate.hpp"

namespace dashpot::compiler {

PassivityBound not_proved(std::string reason);

// The reason where samples are so late that two may follow at once.
inline constexpr const char* at_once = "the amplifier lags, and the jitter is a sample or more";

// The reason where the order of samples and commands is not known.
inline constexpr const char* overtaken =
    "a command may act after the next sample is read: \"write_delay\" and \"jitter\" are more than a period together";

// The reason if nothing is known of the estimator.
std::string not_proved_for(const SampledLoop& loop);

// The same bound if the device's own damping is enough for a free tool, for which the brake is off; else one that is
// not proved, with the damping that would be needed.
PassivityBound of_a_free_tool(const PassivityBound& bound, const SampledLoop& loop);

}  // namespace dashpot::compiler
