// What a run of the servo loop came to.
#pragma once

#include <cstdint>
#include <string>

#include <dashpot/servo/admission.hpp>
#include <dashpot/servo/fault.hpp>
#include <dashpot/servo/histogram.hpp>
#include <dashpot/servo/servo_state.hpp>

namespace dashpot {

struct servo_summary {
  admission verdict = admission::admitted;  // where it refuses, the device was never touched and all below is zero
  servo_state state = servo_state::idle;    // in which the loop ended
  bool left_safe = false;                   // the safe command is in force at the end, as far as the device can tell
  bool safe_confirmed = false;              // a sample says so
  bool safe_sent = false;                   // the device took the safe command, whatever became of it
  std::uint64_t periods = 0;                // that were served
  std::uint64_t missed_deadlines = 0;       // periods that were skipped
  std::uint64_t beyond_jitter = 0;          // wake-ups later than the device's stated jitter
  std::uint64_t held = 0;                   // periods without a fresh sample while running
  std::uint64_t motor_clipped = 0;          // commands beyond what the motor can give, or has given
  std::uint64_t brake_clipped = 0;          // commands beyond what the brake can give, or has given
  std::uint64_t shed = 0;                   // commands for which the model let go of forces that the motor cannot make
  double least_share = 1;                   // of all forces that it then kept in one sample
  fault_counts faults;
  fault_report last_fault;
  histogram lateness;           // of the wake-ups [ns]
  histogram response;           // from wake-up until the command had left [ns]
  histogram busy;               // from wake-up until everything was done [ns]
  double lowest_position = 0;   // of the tool, as the model got it; 0 before the first sample [m] or [rad]
  double highest_position = 0;  // likewise
  double largest_force = 0;     // that the model wanted of the motor, its magnitude [N] or [N·m]
  double largest_damping = 0;   // that it wanted of the brake [N·s/m] or [N·m·s/rad]
  double energy = 0;            // taken from the tool by motor and brake since the last start, at least [J]
  double lowest_energy = 0;     // its least value of the whole run; below zero energy was given to the tool [J]
  double stored_at_start = 0;   // by the model as it started, the most of all starts: this much it may give [J]
  std::uint64_t telemetry_dropped = 0;
  std::uint64_t events_dropped = 0;
  int telemetry_error = 0;  // errno of the first failed write, 0: none
};

// Several lines for people, without the log's lines again.
std::string to_text(const servo_summary& summary);

}  // namespace dashpot
