#include "motion.hpp"

#include "support/random.hpp"

namespace dashpot::responses {

std::vector<Sample> samples_of(const Motion& motion, double period) {
  std::vector<Sample> samples;
  double position = 0;
  for (const Segment& segment : motion)
    for (int n = 0; n < segment.samples; ++n) {
      position += segment.increment;
      samples.push_back({position, segment.increment / period});
    }
  return samples;
}

Motion ramp(int samples) { return {{samples, 256 * unit_increment}}; }

Motion ramp_and_hold(int ramp, int hold) { return {{ramp, 256 * unit_increment}, {hold, 0}}; }

Motion random_motion(std::uint64_t seed, int segments) {
  testing::Random random(seed);
  Motion motion;
  for (int i = 0; i < segments; ++i) {
    const double slope = random.chance(0.2) ? 0 : double(random.between(0, 2000)) - 1000;
    motion.push_back({static_cast<int>(random.between(1, 40)), slope * unit_increment});
  }
  return motion;
}

}  // namespace dashpot::responses
