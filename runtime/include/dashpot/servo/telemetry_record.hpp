// What the loop reports of one period. The writer thread turns it into a row of the log.
#pragma once

#include <cstdint>

#include <dashpot/servo/fault.hpp>
#include <dashpot/servo/servo_state.hpp>

namespace dashpot {

struct telemetry_record {
  double time = 0;           // of the period's release, since the loop's start [s]
  std::uint64_t period = 0;  // from 0; a gap is a missed deadline
  servo_state state = servo_state::idle;
  fault tripped = fault::none;  // the fault that ended the running state in this period
  bool fresh = false;           // false: no new sample, the command before was held
  std::int64_t lateness = 0;    // of the wake-up [ns]
  std::int64_t response = 0;    // from the wake-up until the command had left [ns]
  double position = 0;          // what the model was given [m] or [rad]
  double velocity = 0;          // the estimate it was given [m/s] or [rad/s]
  double damping = 0;           // its command [N·s/m] or [N·m·s/rad]
  double motor_force = 0;       // its command, opposing +position [N] or [N·m]
  double motor_torque = 0;      // sent to the joint, along +q [N·m] or [N]
  double brake_damping = 0;     // sent to the joint [N·m·s/rad] or [N·s/m]
  double stored_energy = 0;     // in the model [J]
  double energy = 0;            // taken from the tool since the start by motor and brake, at least [J]
};

}  // namespace dashpot
