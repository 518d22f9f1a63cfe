// Motions that are linear between samples.
#pragma once

#include <cstdint>
#include <vector>

namespace dashpot::responses {

// Increments are whole numbers of this, so that positions are exact in double and in float.
inline constexpr double unit_increment = 0x1p-20;  // [m] or [rad]

struct Segment {
  int samples;
  double increment;  // of the position, each sample [m] or [rad]
};
using Motion = std::vector<Segment>;

struct Sample {
  double position;  // [m] or [rad]
  double velocity;  // slope of the period that ends with the sample [m/s] or [rad/s]
};

// From rest at 0, the first sample one period later.
std::vector<Sample> samples_of(const Motion& motion, double period);

Motion ramp(int samples);
Motion ramp_and_hold(int ramp, int hold);

// Rises, falls and rests of 1 to 40 samples.
Motion random_motion(std::uint64_t seed, int segments);

}  // namespace dashpot::responses
