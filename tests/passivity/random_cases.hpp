// Random networks with slips, contacts and tunable parameters on random devices, compiled.
#pragma once

#include "certified_loop.hpp"

namespace dashpot::testing {

// Trees and others, some behind a contact on a device that is heavily damped by itself. `lags`: the amplifier; then
// without contacts.
CompiledCase slip_case(std::uint64_t seed, bool lags = false, const char* law = nullptr);

// Behind a contact, with slips or without, on a device with a share of the damping that the certificate asks for;
// without delays and lags.
CompiledCase contact_case(std::uint64_t seed, double share);

// With tunable parameters, and slips in every other one.
CompiledCase tunable_case(std::uint64_t seed);

}  // namespace dashpot::testing
