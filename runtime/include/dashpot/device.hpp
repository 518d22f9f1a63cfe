// The interface between a servo loop and a device: simulated, a board on a byte stream, or a user's own hardware.
//
// A device is any type with
//     dashpot::device_status read(dashpot::device_sample&) noexcept;             // newest sample; must not block
//     dashpot::device_status write(const dashpot::actuation&) noexcept;          // takes effect as soon as possible
//     const dashpot::device_description& description() const noexcept;
// and, where it has more to say when it answers `fault`,
//     const char* cause() const noexcept;                                        // in words, never null; a literal
// Everything is in the joint's own coordinate (device_description.hpp). No call allocates or takes a lock.
#pragma once

#include <cstdint>

#include <dashpot/device_description.hpp>

namespace dashpot {

enum class device_status : unsigned char { ok, no_data, stale, corrupted, disconnected, fault };

struct actuation {
  double motor_torque = 0;   // torque along +q that the motor makes [N·m] or [N]: minus the command's force
  double brake_damping = 0;  // [N·m·s/rad] or [N·s/m], 0 … max_damping
};

// The newest command that was in force at a sample, after the device's own limits. A device that fills it in lets the
// loop confirm that it was left safe, count what the device clips, and reckon the energy with what was applied. A
// number in it that is not finite is a fault.
struct device_report {
  bool told = false;          // false: the device does not tell
  unsigned commands_ago = 0;  // how many have left since through write() with `ok`; 0: it is the newest
  actuation applied;
};

struct device_sample {
  double position = 0;             // [rad] or [m], already quantised by the encoder
  double velocity = 0;             // [rad/s] or [m/s]; meaningful only where the device senses it
  std::int64_t counts = 0;         // raw encoder reading
  std::uint64_t timestamp_ns = 0;  // device clock at the sample
  std::uint64_t edge_time_ns = 0;  // device clock at the newest encoder edge; 0: not measured
  std::uint32_t sequence = 0;      // grows by one a sample
  device_report report;            // where the device tells what has become of the commands
};

}  // namespace dashpot
