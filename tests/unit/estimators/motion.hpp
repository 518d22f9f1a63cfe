// Motions with known velocity, and how a device would sample them.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include <dashpot/device.hpp>
#include <dashpot/estimators/half_turns.hpp>

namespace dashpot {

struct test_motion {
  std::function<double(double)> position;  // of time [s] → [m] or [rad]
  std::function<double(double)> velocity;  // [m/s] or [rad/s]
};

// Velocity mean + peak·sin(2π frequency t), position `offset` in the middle of a swing at t = 0.
inline test_motion sine(double mean, double peak, double frequency, double offset = 0) {
  const double rate = 2 * pi * frequency;
  return {[=](double t) { return offset + mean * t - peak / rate * std::cos(rate * t); },
          [=](double t) { return mean + peak * std::sin(rate * t); }};
}

// Velocity start + acceleration·t.
inline test_motion ramp(double start, double acceleration) {
  return {[=](double t) { return (start + acceleration * t / 2) * t; },
          [=](double t) { return start + acceleration * t; }};
}

inline double floored(double position, double step) { return step * std::floor(position / step); }

// The time in (before, after] at which `motion`, monotone there, first had the count it has at `after`.
inline double edge_between(const test_motion& motion, double step, double before, double after) {
  const double arrived = std::floor(motion.position(after) / step);
  while (after - before > 1e-12) {
    const double middle = (before + after) / 2;
    (std::floor(motion.position(middle) / step) == arrived ? after : before) = middle;
  }
  return after;
}

// Samples of a motion through a flooring encoder that stamps its edges; a step of 0 is an ideal encoder without edges.
class sampled_motion {
 public:
  sampled_motion(test_motion motion, double step, double sample_period)
      : motion_(std::move(motion)), step_(step), sample_period_(sample_period) {}

  double time() const { return index_ * sample_period_; }

  device_sample next() {
    ++index_;
    device_sample sample;
    const double exact = motion_.position(time());
    sample.position = step_ > 0 ? floored(exact, step_) : exact;
    sample.velocity = motion_.velocity(time());
    sample.timestamp_ns = nanoseconds(time());
    if (step_ > 0 && sample.position != previous_position_)
      edge_time_ns_ = nanoseconds(edge_between(motion_, step_, time() - sample_period_, time()));
    sample.edge_time_ns = edge_time_ns_;
    previous_position_ = sample.position;
    return sample;
  }

  double velocity() const { return motion_.velocity(time()); }

 private:
  // A device clock that reads 100 s at t = 0, so that motions may begin before.
  static std::uint64_t nanoseconds(double time) { return static_cast<std::uint64_t>((100 + time) * 1e9); }

  test_motion motion_;
  double step_;           // [m] or [rad]
  double sample_period_;  // [s]
  int index_ = -1;
  double previous_position_ = 0;
  std::uint64_t edge_time_ns_ = 1;
};

}  // namespace dashpot
