// Random numbers that depend on nothing but their own place, so that asking for one more never shifts the others.
#pragma once

#include <cstdint>

namespace dashpot::simulated {

enum class draw_stream : std::uint64_t { jitter, brake_gain, sensor_noise, motor_noise, write };

double draw_uniform(std::uint64_t seed, draw_stream stream, std::uint64_t index);  // in [0, 1)
double draw_normal(std::uint64_t seed, draw_stream stream, std::uint64_t index);   // mean 0, variance 1

}  // namespace dashpot::simulated
