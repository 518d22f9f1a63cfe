// What a simulated device is put through: who holds it, what stands in its way, what goes wrong.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <dashpot/device_description.hpp>
#include <dashpot/simulated/end_stop.hpp>
#include <dashpot/simulated/hand.hpp>
#include <dashpot/simulated/sample_fault.hpp>
#include <dashpot/simulated/trajectory.hpp>
#include <dashpot/transmission.hpp>

namespace dashpot::simulated {

// Where the brake's true gain lies within 1 ± tolerance.
enum class brake_gain : unsigned char { nominal, lowest, highest, drawn };

// Everything in the tool's coordinate, in which the network acts.
struct scenario {
  // How the network moves, a law's `port_motion`. Empty: [m] where an arm radius relates the tool to a rotary joint,
  // else as the joint.
  std::optional<motion> network;
  hand user;                     // of the tool
  trajectory intended;           // of the user; empty: stays at 0
  bool prescribed = false;       // the tool itself follows `intended`, whatever force that takes; `user` is not used
  double initial_position = 0;   // [m] or [rad]; a prescribed motion has its own
  double initial_velocity = 0;   // [m/s] or [rad/s]
  std::optional<end_stop> low;   // below it the tool does not move freely
  std::optional<end_stop> high;  // above it
  brake_gain gain = brake_gain::nominal;
  std::uint64_t seed = 0;  // of jitter, drawn gain, sensor and amplifier noise
  unsigned substeps = 0;   // integration steps a period; 0: chosen so that every rate of the plant is resolved
  std::vector<sample_fault> faults;
};

inline motion tool_motion(const device_description& device, const scenario& scene) noexcept {
  return scene.network.value_or(device.arm_radius > 0 ? motion::translation : device.motion);
}

// Requires can_drive(device, tool_motion(device, scene)).
inline double tool_over_joint(const device_description& device, const scenario& scene) noexcept {
  return transmission<double>(device, tool_motion(device, scene)).ratio();
}

}  // namespace dashpot::simulated
