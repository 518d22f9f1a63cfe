// What is mounted on the shaft: an incremental encoder that notes the time of its edges, and where the device has one,
// a velocity sensor. Both follow the true motion; the position is quantised before anything else sees it.
#pragma once

#include <cmath>
#include <cstdint>

#include <dashpot/device_description.hpp>

namespace dashpot::simulated {

// The shaft at one instant, in the joint's coordinate.
struct shaft_motion {
  double time = 0;      // [s]
  double position = 0;  // [rad] or [m]
  double velocity = 0;  // [rad/s] or [m/s]
};

// As a device's clock counts them; 0 for an instant before its start.
inline std::uint64_t nanoseconds(double seconds) noexcept {
  return seconds > 0 ? static_cast<std::uint64_t>(std::llround(seconds * 1e9)) : 0;
}

class shaft_sensors {
 public:
  shaft_sensors(const device_description& device, const shaft_motion& start);

  // The shaft went from `before` to `after`, between them along the cubic that has these positions and velocities.
  void follow(const shaft_motion& before, const shaft_motion& after) noexcept;

  std::int64_t counts(double position) const noexcept;  // 0 for an ideal encoder
  double quantised(double position) const noexcept;     // [rad] or [m]
  double newest_edge() const noexcept;                  // [s]; negative: none so far, or an ideal encoder
  double sensed_velocity() const noexcept { return sensed_velocity_; }  // without noise; 0 without a sensor

 private:
  // Hermite's cubic between two instants; a `share` of the time between them is in [0, 1].
  struct cubic {
    shaft_motion before, after;

    double duration() const noexcept { return after.time - before.time; }
    double position(double share) const noexcept;
    double crossing(double level, double from, double to) const noexcept;
  };
  // Its instant is worked out only when somebody asks.
  struct edge {
    cubic path;
    double level = 0;  // [rad] or [m]
    double from = 0;   // shares of the path's time between which it crosses the level
    double to = 0;
    bool exists = false;
  };
  double whole_steps(double position) const noexcept;
  void find_edge(const cubic& path, double from, double to) noexcept;
  void sense_velocity(const shaft_motion& before, const shaft_motion& after) noexcept;

  encoder_description encoder_;
  bool has_velocity_sensor_;
  double sensor_rate_;  // 2π·bandwidth [1/s]; 0: unlimited
  edge edge_;
  double sensed_velocity_ = 0;
};

}  // namespace dashpot::simulated
