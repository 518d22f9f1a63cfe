// What an emitted law answers to a motion, sample by sample.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "ramp_and_hold.hpp"

namespace dashpot::paper {

struct ResponseSample {
  double time;          // [s]
  double position;      // [m]
  double closed_form;   // force of the network [N]
  double brake, motor;  // parts of the emitted force [N]

  double emitted() const { return brake + motor; }
  double error() const { return emitted() - closed_form; }
};

// Runs `Law` from rest, once a sample period from 0 to `end` [s], with the true velocity.
template <class Law>
std::vector<ResponseSample> respond(const MaxwellSolid& solid, const RampAndHold& motion, double end) {
  Law law;
  law.reset();
  std::vector<ResponseSample> samples;
  const long last = std::lround(end / Law::sample_period);
  const double rate = std::round(1 / Law::sample_period);  // times as quotients: sums of 0.2 s drift off the knots
  for (long k = 0; k <= last; ++k) {
    const double time = double(k) / rate;
    const double position = motion.position(time), velocity = motion.velocity(time);
    const auto command = law.step(position, velocity);
    samples.push_back(
        {time, position, closed_form_force(solid, motion, time), command.damping * velocity, command.force});
  }
  return samples;
}

// The sample whose force is furthest from the closed form, the largest force [N], and the one over the other.
inline const ResponseSample& worst(const std::vector<ResponseSample>& samples) {
  return *std::max_element(samples.begin(), samples.end(), [](const ResponseSample& a, const ResponseSample& b) {
    return std::abs(a.error()) < std::abs(b.error());
  });
}
inline double peak(const std::vector<ResponseSample>& samples) {
  double force = 0;
  for (const ResponseSample& sample : samples) force = std::max(force, std::abs(sample.closed_form));
  return force;
}
inline double relative_error(const std::vector<ResponseSample>& samples) {
  return std::abs(worst(samples).error()) / peak(samples);
}

}  // namespace dashpot::paper
