// Everything that sends the servo loop into its safe state, and how each is counted and named.
#pragma once

#include <cstdint>

namespace dashpot {

enum class fault : unsigned char {
  none,
  missed_deadlines,       // more in a row than the device allows
  no_data,                // more periods in a row without a fresh sample than the device allows
  device_error,           // the device is disconnected or reports a fault of its own, reading or writing
  position_not_finite,    //
  report_not_finite,      // what the device says that a motor or a brake applies
  position_out_of_range,  // outside the encoder's stated range
  encoder_jump,           // further from the sample before than the speed limit permits
  velocity_not_finite,    // from the estimator
  overspeed,              // estimated velocity above the speed limit
  command_not_finite,     // from the model, or on its way to the device
  motor_saturated,        // without interruption for longer than the device allows
  suspended,              // the machine was asleep between two periods
};

inline constexpr unsigned fault_kinds = static_cast<unsigned>(fault::suspended) + 1;

// "encoder jump": what log and telemetry print. "none" for fault::none.
constexpr const char* name_of(fault which) noexcept {
  switch (which) {
    case fault::none: return "none";
    case fault::missed_deadlines: return "missed deadlines";
    case fault::no_data: return "no data";
    case fault::device_error: return "device error";
    case fault::position_not_finite: return "position not finite";
    case fault::report_not_finite: return "report not finite";
    case fault::position_out_of_range: return "position out of range";
    case fault::encoder_jump: return "encoder jump";
    case fault::velocity_not_finite: return "velocity not finite";
    case fault::overspeed: return "overspeed";
    case fault::command_not_finite: return "command not finite";
    case fault::motor_saturated: return "motor saturated";
    case fault::suspended: return "suspended";
  }
  return "unknown";
}

// One fault with its evidence. `seen` and `limit` share the unit of what was checked: [rad] or [m], [rad/s] or [m/s],
// periods, [s] for a saturation or a suspension; for a device error `seen` is the device_status, and `cause` what the
// device says of it.
struct fault_report {
  fault kind = fault::none;
  double seen = 0;
  double limit = 0;
  const char* cause = nullptr;  // a literal

  constexpr explicit operator bool() const noexcept { return kind != fault::none; }
};

class fault_counts {
 public:
  constexpr void count(fault which) noexcept { ++counts_[static_cast<unsigned>(which)]; }
  constexpr std::uint64_t of(fault which) const noexcept { return counts_[static_cast<unsigned>(which)]; }

  constexpr std::uint64_t total() const noexcept {
    std::uint64_t sum = 0;
    for (const std::uint64_t count : counts_) sum += count;
    return sum;
  }

 private:
  std::uint64_t counts_[fault_kinds] = {};  // [0], for fault::none, stays zero
};

}  // namespace dashpot
