// The interface between a servo loop and a device of two axes, as device.hpp for one:
//     dashpot::device_status read(dashpot::arm_sample&) noexcept;
//     dashpot::device_status write(const dashpot::arm_actuation&) noexcept;
//     const dashpot::arm_description& description() const noexcept;
// and the same optional parts. Everything is in the joints' own coordinates (arm_description.hpp).
#pragma once

#include <cstdint>

#include <dashpot/arm_description.hpp>
#include <dashpot/device.hpp>

namespace dashpot {

struct arm_actuation {
  double motor_torque[arm_axes] = {};          // along +q, that each motor makes [N·m] or [N]
  double brake_damping[most_arm_brakes] = {};  // [N·m·s/rad] or [N·s/m], 0 … max_damping; 0 beyond the device's brakes
};

// After a fault: motors 0, every brake at its safe damping.
constexpr arm_actuation safe_actuation(const arm_description& arm) noexcept {
  arm_actuation safe;
  for (unsigned i = 0; i < arm.brake_count; ++i) safe.brake_damping[i] = arm.brakes[i].brake.safe_damping;
  return safe;
}

// As device_report.
struct arm_report {
  bool told = false;
  unsigned commands_ago = 0;
  arm_actuation applied;
};

// Of all joints at one instant.
struct arm_sample {
  double position[arm_axes] = {};             // [rad] or [m], already quantised
  double velocity[arm_axes] = {};             // [rad/s] or [m/s]; meaningful only where the device senses it
  std::int64_t counts[arm_axes] = {};         // raw encoder readings
  std::uint64_t timestamp_ns = 0;             // device clock at the sample
  std::uint64_t edge_time_ns[arm_axes] = {};  // device clock at the newest encoder edges; 0: not measured
  std::uint32_t sequence = 0;                 // grows by one a sample
  arm_report report;

  // As the parts for one axis take it; without the report.
  constexpr device_sample of_joint(unsigned joint) const noexcept {
    return {position[joint], velocity[joint], counts[joint], timestamp_ns, edge_time_ns[joint], sequence, {}};
  }
};

}  // namespace dashpot
