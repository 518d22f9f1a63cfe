// What the loop reports of one period, and of a run, for a device of two axes: telemetry_record.hpp and
// servo_summary.hpp, for each joint and brake.
#pragma once

#include <cstdint>

#include <dashpot/arm_device.hpp>
#include <dashpot/servo/servo_summary.hpp>
#include <dashpot/servo/telemetry_record.hpp>

namespace dashpot {

struct arm_telemetry_record {
  double time = 0;  // of the period's release, since the loop's start [s]
  std::uint64_t period = 0;
  servo_state state = servo_state::idle;
  fault tripped = fault::none;
  bool fresh = false;
  std::int64_t lateness = 0;             // [ns]
  std::int64_t response = 0;             // [ns]
  double position[arm_axes] = {};        // what the model was given [rad] or [m]
  double velocity[arm_axes] = {};        // the estimates it was given [rad/s] or [m/s]
  double damping[most_arm_brakes] = {};  // its command [N·m·s/rad] or [N·s/m]
  double torque[arm_axes] = {};          // its command, opposing +q [N·m] or [N]
  arm_actuation sent;                    // to motors, along +q, and brakes
  double stored_energy = 0;              // in the model [J]
  double energy = 0;                     // taken from the tool since the start by motors and brakes, at least [J]
};

// Of the summary's counts, `motor_clipped` and `brake_clipped` count every motor's and every brake's commands.
struct arm_servo_summary : servo_summary {
  double lowest_positions[arm_axes] = {};         // of the joints, as the model got them [rad] or [m]
  double highest_positions[arm_axes] = {};        //
  double lowest_tip[2] = {};                      // least x and y [m]
  double highest_tip[2] = {};                     // [m]
  double largest_torques[arm_axes] = {};          // that the model wanted of each motor, their magnitudes [N·m] or [N]
  double largest_dampings[most_arm_brakes] = {};  // of each brake [N·m·s/rad] or [N·s/m]
};

// The columns of a run: of what motion the joints are, and how many brakes there are.
struct arm_telemetry_units {
  constexpr arm_telemetry_units(motion of_joints, unsigned brake_count) noexcept
      : joint(of_joints), brakes(brake_count) {}

  motion joint;
  unsigned brakes;
};

}  // namespace dashpot
