// How many cases a random test takes: a seeded sample, or as many as `./check --long` asks for.
#pragma once

#include <cstddef>

namespace dashpot::testing {

// Whether the environment variable DASHPOT_LONG is 1.
bool is_thorough();

// `usual`, or `thorough` in a thorough run. No test reads that variable itself.
std::size_t repetitions(std::size_t usual, std::size_t thorough);

}  // namespace dashpot::testing
